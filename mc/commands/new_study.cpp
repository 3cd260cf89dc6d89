#include <fmt/format.h>

#include <filesystem>
#include <string>

#include "mc/commands/commands.hpp"
#include "mc/new_study/planetary.hpp"
#include "mc/new_study/rexs_study.hpp"
#include "mc/report/page.hpp"
#include "mc/run/support.hpp"
#include "mc/scene/mesh_loads.hpp"

namespace gearpod::mc {
namespace {

// Comment from which editors take the JSON schema of the study.
std::string schema_line() {
    const std::string schema = schema_path().string();
    return schema.empty() ? "" : "#:schema " + schema + "\n";
}

// Prints warnings of a torque that cannot be meant.
void warn_of_load(const NewStudy& made, const std::string& path) {
    const StudyReading reading = read_study_text(made.text, path);
    if (reading.study) {
        print_problems(load_warnings(*reading.study, path == "-" ? "the study" : path));
    }
}

}  // namespace

int new_command(const NewOptions& options) {
    const bool exists = options.out != "-" && std::filesystem::exists(options.out);
    if (exists && !options.force) {
        fmt::print(stderr, "--out {}: exists already; choose another file, or give --force\n",
                   options.out);
    }
    const bool writable = can_write({"--out", options.out}, {{"the model", options.rexs}}) &&
                          (!exists || options.force);
    const NewStudy made = options.rexs.empty()
                              ? new_planetary(options.planetary, options.command)
                              : new_from_rexs(options.rexs, options.rexs_choices, options.command);
    print_problems(made.problems);
    if (!made.problems.empty() || !writable ||
        !write_text_to(options.out, schema_line() + made.text)) {
        return kBadInput;
    }
    print_problems(made.notices);
    warn_of_load(made, options.out);
    if (options.out != "-") {
        fmt::print(
            "{0}: check its values and replace those that you know, then\n"
            "  gearpod describe {0}\n  gearpod run {0}\n",
            options.out);
    }
    return kDone;
}

}  // namespace gearpod::mc
