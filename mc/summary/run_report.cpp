#include "mc/summary/run_report.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "analysis/report/detection_text.hpp"
#include "analysis/report/false_alarm_text.hpp"
#include "analysis/report/text_lines.hpp"
#include "mc/input/wrapped_text.hpp"
#include "mc/numerics/numerical_error.hpp"
#include "mc/numerics/step_error.hpp"
#include "mc/results/failure_text.hpp"
#include "mc/results/reliability_of_results.hpp"
#include "mc/study/assumptions.hpp"
#include "mc/summary/alarms_over_time.hpp"
#include "mc/summary/contact_loss.hpp"
#include "mc/summary/feature_values.hpp"
#include "mc/summary/monitoring_over_time.hpp"

namespace gearpod::mc {
namespace {

struct TimeRow {
    const char* name;
    double (*of)(const TeamTimes&);
};
constexpr TimeRow kTimeRows[] = {
    {"sampling", [](const TeamTimes& t) { return t.work.sampling; }},
    {"stiffness", [](const TeamTimes& t) { return t.work.stiffness; }},
    {"integration", [](const TeamTimes& t) { return t.work.integration; }},
    {"signals", [](const TeamTimes& t) { return t.work.signals; }},
    {"noise", [](const TeamTimes& t) { return t.work.noise; }},
    {"features", [](const TeamTimes& t) { return t.work.features; }},
    {"waiting", [](const TeamTimes& t) { return t.waiting; }},
    {"output", [](const TeamTimes& t) { return t.output; }}};

struct Spread {
    double least = 0.0, sum = 0.0, most = 0.0;
};

Spread spread_of(const std::vector<TeamTimes>& teams, const TimeRow& row) {
    Spread spread{row.of(teams[0]), 0.0, 0.0};
    for (const TeamTimes& crew : teams) {
        const double seconds = row.of(crew);
        spread.least = std::min(spread.least, seconds);
        spread.most = std::max(spread.most, seconds);
        spread.sum += seconds;
    }
    return spread;
}

}  // namespace

RowCounts count_rows(const RowSource& rows, std::size_t records) {
    RowCounts counts;
    rows.visit([&](const RowBlock& block) {
        for (std::size_t row = 0; row < block.count(); ++row) {
            const bool threshold = block.group[row] == static_cast<int>(Group::threshold);
            if (threshold && (block.first + row) % records != 0) {
                continue;  // a further record of the gearbox before
            }
            ++counts.all;
            const int status = block.status[row];
            if (status >= 0 && status < kStatuses) {
                ++counts.with_status[static_cast<std::size_t>(status)];
            }
        }
    });
    counts.not_converged = counts.with_status[static_cast<std::size_t>(Status::not_converged)];
    counts.diverged = counts.all - counts.not_converged -
                      counts.with_status[static_cast<std::size_t>(Status::ok)];
    return counts;
}

std::string results_text(const Results& frame, const RowSource& rows,
                         const std::optional<analysis::Reliability>& reliability) {
    const auto study = read_study_text(frame.provenance_value("study"), "").study;
    std::string text;
    if (const std::string part = frame.provenance_value("part"); !part.empty()) {
        analysis::add_wrapped(
            text,
            fmt::format("Part {} of the study only; join all parts with `gearpod merge`.", part),
            2);
    }
    if (const std::string shortage =
            analysis::sample_shortage(frame.detection, frame.request, subject_of(frame));
        !shortage.empty()) {
        analysis::add_wrapped(text, shortage, 2);
    }
    if (const std::string holds = study ? assumptions(*study, false) : ""; !holds.empty()) {
        analysis::add_wrapped(text, holds, 2);
        text += "\n";
    }
    const std::string values = feature_values_text(frame, rows);
    text += (values.empty()
                 ? analysis::detection_text(frame.detection, frame.request, subject_of(frame))
                 : values) +
            "\n" + reliability_text(reliability, frame);
    const std::string times = alarms_text(frame, alarms_over_time(frame, rows), reliability);
    text += times.empty() ? "" : "\n" + times;
    if (const auto monitoring = monitoring_over_time(frame, rows)) {
        constexpr std::size_t kMostNamed = 3;
        std::vector<std::string> best;
        for (const std::size_t f : ranked_features(frame, reliability)) {
            if (best.size() < kMostNamed) {
                best.push_back(frame.features[f].name);
            }
        }
        text += "\n" + monitoring_text(*monitoring, best);
    }
    if (const std::string loss = contact_loss_text(summarise_contact_loss(frame, rows));
        !loss.empty()) {
        text += "\n";
        analysis::add_wrapped(
            text,
            "Share of time that a tooth pair is out of contact, mean (5 to 95 % range of the "
            "gearboxes): " +
                loss + ".",
            2);
    }
    if (frame.step_error) {
        analysis::add_wrapped(
            text, "Error of the time steps: " + step_error_text(*frame.step_error) + ".", 2);
    }
    const std::string numerical =
        numerical_text(frame, numerical_contributions(frame, rows, reliability));
    return numerical.empty() ? text : text + "\n" + numerical;
}

void print_failures(const RowCounts& rows, int max_meshes) {
    fmt::print("gearboxes: {} of {} failed ({} diverged, {} did not converge)\n", rows.failed(),
               rows.all, rows.diverged, rows.not_converged);
    for (const Status status : {Status::supercritical, Status::parametric, Status::step_too_long,
                                Status::no_equilibrium}) {
        const std::size_t count = rows.with_status[static_cast<std::size_t>(status)];
        if (count > 0) {
            const std::string reason =
                fmt::format("{} of them: each {}", count, failure_text(status));
            fmt::print("  {}\n", wrapped_text(reason, 2));
        }
    }
    if (rows.not_converged > 0) {
        fmt::print(
            "  (no convergence to the periodic orbit within {} mesh periods: raise\n"
            "  numerics.max_meshes or numerics.settle_tolerance)\n",
            max_meshes);
    }
}

void print_computing_times(const EnsembleOutcome& outcome) {
    const int threads = outcome.threads();
    const std::size_t ranks = outcome.teams.size();
    fmt::print("computing time ({} rank{}, {} thread{} in total, {:.1f} s):\n", ranks,
               ranks == 1 ? "" : "s", threads, threads == 1 ? "" : "s", outcome.wall_s);
    fmt::print("  {:<11} {:>7} {:>12}{}\n", "", "share", "thread s",
               ranks > 1 ? "   per rank: least, mean, most" : "");
    const double total = std::max(1e-9, threads * outcome.wall_s);
    const auto print_row = [&](const char* name, const Spread& spread) {
        fmt::print("  {:<11} {:5.1f} % {:12.2f}", name, 100.0 * spread.sum / total, spread.sum);
        if (ranks > 1) {
            fmt::print("   {:9.2f} {:9.2f} {:9.2f}", spread.least,
                       spread.sum / static_cast<double>(ranks), spread.most);
        }
        fmt::print("\n");
    };
    for (const TimeRow& row : kTimeRows) {
        print_row(row.name, spread_of(outcome.teams, row));
    }
    const Seconds work = outcome.work();
    if (const long records = work.superposed + work.superposition_fallbacks; records > 0) {
        fmt::print(
            "  (integration: {} of {} records superposed; {} integrated in full, because a\n"
            "  tooth pair may lose contact or the fault acts during the whole span)\n",
            work.superposed, records, work.superposition_fallbacks);
    }
    fmt::print("  (output: checkpoints, written in parallel by the main thread of rank 0)\n");
}

}  // namespace gearpod::mc
