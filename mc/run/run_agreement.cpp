#include "mc/run/run_agreement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "machine/cancellation.hpp"
#include "mc/random/fnv.hpp"
#include "mc/results/provenance.hpp"
#include "mc/results/run_identity.hpp"
#include "mc/run/support.hpp"

namespace gearpod::mc {
namespace {

// Checksum of the program's file, which reveals a rebuild between the starts of two ranks.
std::string program_sum() {
    std::ifstream stream("/proc/self/exe", std::ios::binary);
    std::uint64_t sum = kFnvStart;
    std::string piece(std::size_t{1} << 20, '\0');
    while (stream.read(piece.data(), static_cast<std::streamsize>(piece.size())),
           stream.gcount() > 0) {
        sum = fnv1a({piece.data(), static_cast<std::size_t>(stream.gcount())}, sum);
    }
    return fmt::format("{:016x}", sum);
}

// Reason why a rank other than 0 cannot take part, or "".
std::string rank_mismatch(const std::string& name, const std::string& program,
                          const std::string& first_program, const std::string& study,
                          const std::string& first_study) {
    if (program != first_program) {
        return fmt::format(
            "{} runs another program ({}; rank 0: {}); start the same program on all ranks", name,
            program, first_program);
    }
    const std::string line = line_difference(first_study, study, "in rank 0");
    return line.empty() ? "" : fmt::format("{} read another study ({})", name, line);
}

StudyScene make_in_time(const StudyOptions& options, const Interruption& interruption,
                        const std::function<void(StudyScene&)>& prepare) {
    try {
        StudyScene made = make_scene(options);
        if (made && prepare) {
            prepare(made);
        }
        return made;
    } catch (const machine::Cancelled&) {
        const std::string reason = interruption.reason({});
        StudyScene none;
        none.problems = {{options.path, 0, "",
                          fmt::format("stopped by {} before its first gearbox",
                                      reason.empty() ? "the time limit" : reason),
                          "nothing has been computed yet; start it again",
                          ProblemKind::interrupted}};
        return none;
    }
}

}  // namespace

StudyScene load_scene_on_all_ranks(const Ranks& ranks, const StudyOptions& options,
                                   const Interruption& interruption,
                                   const std::function<void(StudyScene&)>& prepare) {
    StudyScene made = make_in_time(options, interruption, prepare);
    const auto all_problems = ranks.gather(made ? "" : format(made.problems));
    const auto names = ranks.gather(ranks.size() > 1 ? rank_name(ranks) : "");
    const auto programs =
        ranks.gather(ranks.size() > 1 ? fmt::format("{}, {}", version_text(), program_sum()) : "");
    const auto studies = ranks.gather(made ? resolved_text(made.scene->study()) : "");
    std::string why = all_problems[0];
    for (std::size_t rank = 1; rank < names.size() && why.empty(); ++rank) {
        const std::string& problem = all_problems[rank];
        why = problem.empty() ? rank_mismatch(names[rank], programs[rank], programs[0],
                                              studies[rank], studies[0])
                              : names[rank] + ": " + problem.substr(0, problem.find('\n'));
        why += why.empty() ? "" : "\n";
    }
    if (!why.empty()) {
        made.scene.reset();
    }
    if (ranks.leads()) {
        fmt::print(stderr, "{}", why.empty() ? format(made.notices) : why);
    }
    return made;
}

bool was_interrupted(const Problems& problems) {
    return std::ranges::find(problems, ProblemKind::interrupted, &Problem::kind) != problems.end();
}

}  // namespace gearpod::mc
