#include "span_table.hpp"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <stdexcept>

namespace gearpod::peers {
namespace {

constexpr int kRunIn = 2;
// Number of rounds for a solver whose round takes longer than kSlow_s.
constexpr std::size_t kSlowRounds = 3;
constexpr double kSlow_s = 1.0;

// Limits in half decades: 10^(-n / 2).
constexpr int kLoosest = 2, kFirst = 6, kTightest = 18;

// Integrates at a tolerance; returns nothing if it did not reach the end.
using Trial = std::function<std::optional<Attempt>(double tolerance)>;

// Searches by decades from 1e-3 on, between 1e-1 and 1e-9, and then half a decade back. Returns the
// loosest tolerance that meets the error; if none does, the tightest that reached the end, if any.
std::optional<Attempt> loosest_tolerance(const Trial& trial) {
    const auto at = [&](int n) { return trial(std::pow(10.0, -0.5 * n)); };
    const auto good = [](const std::optional<Attempt>& a) { return a && a->within; };
    int n = kFirst;
    std::optional<Attempt> best = at(n);
    if (good(best)) {
        for (std::optional<Attempt> looser; n - 2 >= kLoosest; n -= 2, best = looser) {
            if (looser = at(n - 2); !good(looser)) {
                break;
            }
        }
    } else {
        while (best && !good(best) && n + 2 <= kTightest) {
            const std::optional<Attempt> tighter = at(n + 2);
            if (!tighter) {  // a tighter one would take longer
                break;
            }
            n += 2;
            best = tighter;
        }
    }
    if (good(best) && n - 1 >= kLoosest) {
        if (const std::optional<Attempt> half = at(n - 1); good(half)) {
            best = half;
        }
    }
    return best;
}

}  // namespace

SpanTable::SpanTable(const Options& options, GearpodSolver& own, const mc::Pilot& pilot,
                     const mc::Reference& reference)
    : options_(options),
      own_(own),
      pilot_(pilot),
      reference_(reference),
      resolved_(study_of(options, {fmt::format("numerics.tolerance={}", options.error)})) {
    span_ = kRunIn + own.scene().record().span.meshes();
    const mc::PilotRecord record = pilot.run(resolved_.study.numerics);
    rows_.push_back({"gearpod, " + resolved_.choice->setting.text(),
                     {},
                     record.meshes_per_tile(),
                     mc::pilot_error(record, reference.record),
                     0.0,
                     static_cast<double>(record.steps)});
    rows_.push_back({"gearpod, rk4 in doubles, every mesh integrated",
                     {},
                     span_,
                     {},
                     0.0,
                     static_cast<double>(own.task().steps.grid().steps.size())});
}

void SpanTable::add_all() {
    constexpr int kGearbox = kLargestCrack;
    add_fixed("odeint rk4, one by one", [](const Task& task, const Extent& extent, double) {
        return vectorized::odeint_rk4(task, extent, kGearbox, kGearbox + 1, false);
    });
    add_fixed("odeint rk4, 8-wide value type", [](const Task& task, const Extent& extent, double) {
        PeerRun run = vectorized::odeint_wide_rk4(task, extent, false);
        run.integration_s /= kGearboxes;
        return run;
    });
    for (const bool stops : {false, true}) {
        const std::string how = stops ? ", restarted at transitions" : "";
        add_adaptive("odeint dopri5" + how, [=](const Task& task, const Extent& extent, double e) {
            return odeint_dopri5(task, extent, kGearbox, kGearbox + 1, e, stops);
        });
        for (const auto& [name, method] : {std::pair("CVODE BDF, dense", Multistep::bdf),
                                           std::pair("CVODE BDF, sparse", Multistep::sparse_bdf),
                                           std::pair("CVODE Adams", Multistep::adams)}) {
            add_adaptive(name + how, [=](const Task& task, const Extent& extent, double e) {
                return cvode(task, extent, kGearbox, kGearbox + 1, method, e, stops);
            });
        }
    }
}

std::optional<Attempt> SpanTable::attempt(const std::string& name, const Way& way,
                                          double tolerance) const {
    const PeerRun run =
        way(own_.task(), {kRunIn, own_.task().steps.meshes(), options_.try_s}, tolerance);
    fmt::print(stderr, "{}, {:.1e}: ", name, tolerance);
    if (run.late || run.failed) {
        fmt::print(stderr, "{} after {:.1f} s\n", run.late ? "given up" : "failed",
                   run.integration_s);
        return {};
    }
    Attempt done{
        tolerance, run.steps,
        error_of(own_.study(), run.records, kLargestCrack, kLargestCrack + 1, reference_.record)};
    done.within = done.error.largest_feature() <= options_.error;
    fmt::print(stderr,
               "worst feature {:.1e}, sensor {:.1e}, {:.0f} steps a mesh period, {:.1f} s\n",
               done.error.largest_feature(), done.error.sensor, run.steps, run.integration_s);
    return done;
}

void SpanTable::add_fixed(const std::string& name, Way way) {
    const std::optional<Attempt> done = attempt(name, way, 0.0);
    rows_.push_back({name, {}, span_, done->error, 0.0, done->steps, done->within});
    ways_.push_back(std::move(way));
}

void SpanTable::add_adaptive(const std::string& name, Way way) {
    const std::optional<Attempt> best =
        loosest_tolerance([&](double tolerance) { return attempt(name, way, tolerance); });
    if (!best) {
        fmt::print(stderr, "{}: no tolerance tried came to the end\n", name);
        return;
    }
    rows_.push_back({name, {}, span_, best->error, best->tolerance, best->steps, best->within});
    ways_.push_back(std::move(way));
}

void SpanTable::round() {
    rows_[0].times.push_back(pilot_.run(resolved_.study.numerics).integration_s);
    rows_[1].times.push_back(own_.tile_mesh_s() / kGearboxes * span_);
    for (std::size_t i = 0; i < ways_.size(); ++i) {
        Row& row = rows_[i + 2];
        const bool slow = !row.times.empty() && row.times.front() > kSlow_s / 2.0 * span_;
        if (slow && row.times.size() >= kSlowRounds) {
            continue;
        }
        const PeerRun run = ways_[i](own_.task(), {1, 1}, row.tolerance);
        row.times.push_back(run.integration_s / 2.0 * span_);
    }
}

void SpanTable::add_to(nlohmann::ordered_json& part) const {
    nlohmann::ordered_json rows;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
        const Row& row = rows_[i];
        const auto whole = ratio_json(row, rows_[0]);
        const auto mesh = ratio_json(row, rows_[0], rows_[0].meshes / row.meshes);
        const auto error = [&](auto member) {
            return row.error ? fmt::format("{:.1e}", member(*row.error)) : std::string();
        };
        rows.push_back({row.name, row.tolerance > 0.0 ? fmt::format("{:.0e}", row.tolerance) : "",
                        fmt::format("{:.0f}", row.steps), median(row.times), i == 0 ? one() : whole,
                        i == 0 ? one() : mesh, error([](const auto& e) {
                                                   return e.largest_feature();
                                               }) + (row.within ? "" : " (above)"),
                        error([](const auto& e) { return e.sensor; })});
        if (i > 0) {
            part["ratios"]["gearbox: " + row.name] = whole;
            part["ratios"]["mesh period: " + row.name] = mesh;
        }
    }
    part["tables"].push_back(
        {{"title", fmt::format("A gearbox of {} + {} mesh periods, worst feature within {:g}:",
                               kRunIn, own_.scene().record().span.meshes(), options_.error)},
         {"columns",
          {"solver", "tolerance", "steps per mesh period", "s", "over gearpod",
           "mesh period, over gearpod's", "worst feature", "sensor"}},
         {"rows", rows}});
}

void SpanTable::write(const std::string& path) const {
    std::ofstream file(path);
    file << "name,command,integration_s,mesh_s,sensor,te";
    for (const std::string& feature : own_.study().features.use) {
        file << ',' << feature;
    }
    file << '\n';
    const int levels = static_cast<int>(own_.study().sensor.noise_levels.size());
    for (std::size_t i = 2; i < rows_.size(); ++i) {
        const Row& row = rows_[i];
        const double integration_s = median(row.times);
        file << fmt::format("\"{}\",peer_solvers,{:.6g},{:.6g},{:.6g},{:.6g}", row.name,
                            integration_s, integration_s / row.meshes, row.error->sensor,
                            row.error->te);
        for (std::size_t f = 0; f < own_.study().features.use.size(); ++f) {
            file << fmt::format(",{:.6g}", row.error->feature(static_cast<int>(f), levels));
        }
        file << '\n';
    }
    if (!file.flush()) {
        throw std::runtime_error(path + ": cannot be written");
    }
}

}  // namespace gearpod::peers
