// accuracy_text(): writes an accuracy report as text.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "mc/accuracy/report.hpp"

namespace gearpod::mc {
namespace {

using Text = std::back_insert_iterator<std::string>;

std::string short_number(double value) {
    return std::isfinite(value) ? fmt::format("{:.1e}", value) : "-";
}

std::string worst_feature(const AccuracyReport& report, const PilotError& error) {
    std::size_t worst = 0;
    for (std::size_t f = 1; f < report.features.size(); ++f) {
        if (error.feature(static_cast<int>(f), report.levels()) >
            error.feature(static_cast<int>(worst), report.levels())) {
            worst = f;
        }
    }
    return report.features[worst];
}

void add_head(const AccuracyReport& report, Text out) {
    const Reference& r = report.reference;
    fmt::format_to(
        out,
        "pilot: {} gearboxes, signals over {} mesh period(s), features over {}\n"
        "reference: {}{}; against {}{}:\n"
        "  relative L2 {:.1e} (sensor), {:.1e} (TE), worst feature {:.1e}{}\n",
        report.gearboxes, report.signal_meshes, report.span_meshes, r.first.text(),
        r.first_order > 0 ? fmt::format(", extrapolated at order {:g}", r.first_order) : "",
        r.second.text(),
        r.second_order > 0 ? fmt::format(", extrapolated at order {:g}", r.second_order) : "",
        r.agreement.sensor, r.agreement.te, r.agreement.largest_feature(),
        r.reached ? "" : "; signals do not agree to 1e-8");
}

void add_heading(Text out) {
    fmt::format_to(
        out,
        "\ntime: processor time of one gearbox in a full tile of eight, of sixteen in "
        "singles (march alone); error: relative L2 of the\nnoise-free sensor signal and of the TE "
        "without its mean; feature: the worst, rms over the gearboxes; * frontier\n\n"
        "{:<44} {:>6} {:>7} {:>9} {:>9} {:>8} {:>8} {:>8}  {}\n",
        "rung", "steps", "meshes", "us/mesh", "us/box", "sensor", "TE", "feature", "worst");
}

void add_row(const AccuracyReport& report, const RungResult& r, const char* mark, Text out) {
    if (!r.refusal.empty()) {
        fmt::format_to(out, "{:<44} refused: {}\n", mark + r.rung.integrator, r.refusal);
        return;
    }
    fmt::format_to(out, "{:<44} {:>6} {:>7.0f} {:>9.2f} {:>9.1f} {:>8} {:>8} {:>8}  {}{}\n",
                   mark + r.rung.text(), r.steps, r.meshes, 1e6 * r.mesh_s, 1e6 * r.march_s,
                   short_number(r.error.sensor), short_number(r.error.te),
                   short_number(r.error.largest_feature()), worst_feature(report, r.error),
                   r.failed > 0 ? fmt::format(" ({:g} failed)", r.failed) : "");
}

// True for settings with fewer terms in the stiffness curves.
bool is_thin(const Rung& rung) {
    return !rung.other.empty() && rung.other.back().starts_with("numerics.stiffness_tolerance");
}

// True for settings that are listed: those of each family with the tightest convergence tolerance,
// the frontier, the chosen ones and the study's own.
bool worth_a_line(const AccuracyReport& report, std::size_t i) {
    const RungResult& r = report.rungs[i];
    return r.frontier || static_cast<int>(i) == report.own ||
           (!r.refusal.empty() && r.refusal != kNotTried) || r.rung.settle_tolerance <= 1e-10 ||
           is_thin(r.rung) ||
           std::any_of(report.choices.begin(), report.choices.end(),
                       [&](const ChoiceCheck& c) { return c.chosen == static_cast<int>(i); });
}

void add_explicit_limit(const AccuracyReport& report, Text out) {
    const ExplicitLimit& e = report.explicit_limit;
    fmt::format_to(out,
                   "\nclassical Runge-Kutta at its stability limit ({}): {:.0f} steps of {:.1f} ns "
                   "(measured) = {:.3g} us/mesh, x {:.0f} meshes = {:.3g} us/box\n",
                   e.refused ? "refused; computed" : "computed", e.steps, 1e9 * e.step_s,
                   1e6 * e.mesh_s(), e.meshes, 1e6 * e.march_s());
}

void add_choices(const AccuracyReport& report, Text out) {
    fmt::format_to(out, "\nnumerics.tolerance\n");
    for (const ChoiceCheck& c : report.choices) {
        if (c.chosen < 0) {
            fmt::format_to(out, "  {:g}: no choice: {}\n", c.tolerance, c.refusal);
            continue;
        }
        const RungResult& chosen = report.rungs[static_cast<std::size_t>(c.chosen)];
        fmt::format_to(out, "  {:g}: {}, worst feature {:.1e}, {:.1f} us/box\n", c.tolerance,
                       chosen.rung.text(), chosen.error.largest_feature(), 1e6 * chosen.march_s);
        if (c.best >= 0) {
            const RungResult& best = report.rungs[static_cast<std::size_t>(c.best)];
            fmt::format_to(out, "    {:+.0f} % of the fastest that keeps it ({}); ",
                           100.0 * c.over_best, best.rung.text());
        }
        fmt::format_to(out, "1/{:.3g} of Runge-Kutta at its limit a mesh, 1/{:.3g} a gearbox\n",
                       report.explicit_limit.mesh_s() / chosen.mesh_s,
                       report.explicit_limit.march_s() / chosen.march_s);
    }
    if (!report.step_costs.empty()) {
        fmt::format_to(out, "  cost of a step over Runge-Kutta's: {}\n",
                       fmt::join(report.step_costs, "; "));
    }
}

void add_features(const AccuracyReport& report, Text out) {
    fmt::format_to(out, "\nfeatures, relative error on the frontier\n{:<44}", "");
    for (const std::string& feature : report.features) {
        fmt::format_to(out, " {:>12.12}", feature);
    }
    fmt::format_to(out, "\n");
    for (const RungResult& r : report.rungs) {
        if (!r.frontier) {
            continue;
        }
        fmt::format_to(out, "{:<44}", r.rung.text());
        for (std::size_t f = 0; f < report.features.size(); ++f) {
            fmt::format_to(out, " {:>12}",
                           short_number(r.error.feature(static_cast<int>(f), report.levels())));
        }
        fmt::format_to(out, "\n");
    }
}

std::string sizes_text(const DetectionChange& d) {
    if (d.a90 < 0.0) {
        return "no a90";
    }
    return fmt::format("{:.2f} %{}", 100.0 * d.a90,
                       std::isfinite(d.a90_interval)
                           ? fmt::format(" (interval {:.1f} %)", 100.0 * d.a90_interval)
                           : "");
}

void add_detection(const AccuracyReport& report, Text out) {
    const auto detected = [](const RungResult& r) { return r.detection.has_value(); };
    const auto first = std::find_if(report.rungs.begin(), report.rungs.end(), detected);
    if (first == report.rungs.end()) {
        return;
    }
    fmt::format_to(out,
                   "\ndetection: the same {} graded gearboxes by the closest rung and by these; "
                   "largest change over features, sizes, noise levels\n"
                   "{:<44} {:>15} {:>22}  {}\n",
                   first->detection->gearboxes, "", "alarms changed", "Pd (half width)", "a90");
    for (const RungResult& r : report.rungs) {
        if (!r.detection) {
            continue;
        }
        const DetectionChange& d = *r.detection;
        fmt::format_to(out, "{:<44} {:>13.3f} % {:>22}  {}\n", r.rung.text(), 100.0 * d.alarms,
                       fmt::format("{:.4f} ({:.3f})", d.pd, d.pd_half_width), sizes_text(d));
    }
}

void add_left_out(const AccuracyReport& report, Text out) {
    if (!report.left_out.empty()) {
        fmt::format_to(out, "\nleft out, the time was up (--seconds 0: nothing is)\n");
        for (const std::string& what : report.left_out) {
            fmt::format_to(out, "  {}\n", what);
        }
    }
}

void add_peers(const AccuracyReport& report, Text out) {
    for (const PeerResult& p : report.peers) {
        fmt::format_to(out, "{:<44} {:>6} {:>7} {:>9.3g} {:>9.3g} {:>8} {:>8} ", p.name, "", "",
                       1e6 * p.mesh_s, 1e6 * p.march_s, short_number(p.sensor), short_number(p.te));
        const auto worst =
            std::max_element(p.features.begin(), p.features.end(),
                             [](const auto& a, const auto& b) { return a.second < b.second; });
        if (worst == p.features.end()) {
            fmt::format_to(out, "{:>8}\n", "-");
        } else {
            fmt::format_to(out, "{:>8}  {}\n", short_number(worst->second), worst->first);
        }
    }
}

}  // namespace

std::string accuracy_text(const AccuracyReport& report) {
    std::string text;
    Text out(text);
    add_head(report, out);
    add_heading(out);
    for (std::size_t i = 0; i < report.rungs.size(); ++i) {
        if (worth_a_line(report, i)) {
            add_row(report, report.rungs[i], report.rungs[i].frontier ? "* " : "  ", out);
        }
    }
    add_peers(report, out);
    add_explicit_limit(report, out);
    add_choices(report, out);
    add_features(report, out);
    add_detection(report, out);
    add_left_out(report, out);
    return text;
}

}  // namespace gearpod::mc
