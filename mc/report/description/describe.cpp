#include "mc/report/description/describe.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "machine/instruction_sets.hpp"
#include "mc/ensemble/ensemble.hpp"
#include "mc/ensemble/gearbox/solution_choice.hpp"
#include "mc/ensemble/ranks.hpp"
#include "mc/files/input/problems.hpp"
#include "mc/files/input/terminal_text.hpp"
#include "mc/lives/campaign.hpp"
#include "mc/lives/interpolation.hpp"
#include "mc/lives/life_tile.hpp"
#include "mc/numerics/forecast/forecast.hpp"
#include "mc/numerics/forecast/memory.hpp"
#include "mc/numerics/measured_effects.hpp"
#include "mc/numerics/numerical_error.hpp"
#include "mc/report/run_sections.hpp"
#include "mc/results/result_rows.hpp"

namespace gearpod::mc {
namespace {

// Columns in which paragraphs and the values of entries start.
constexpr std::size_t kTextColumn = 2, kValueColumn = 28;

constexpr std::size_t kWidth = 80;

// Elements between the first and last character of an array or inline table.
std::vector<std::string> elements(std::string_view value) {
    std::vector<std::string> all(1);
    int depth = 0;
    bool quoted = false, escaped = false;
    for (std::size_t i = 1; i + 1 < value.size(); ++i) {
        const char c = value[i];
        if (c == '"' && !escaped) {
            quoted = !quoted;
        } else if (!quoted) {
            depth += c == '[' || c == '{' ? 1 : c == ']' || c == '}' ? -1 : 0;
        }
        escaped = c == '\\' && !escaped;
        if (c == ',' && depth == 0 && !quoted) {
            all.emplace_back();
        } else if (c != ' ' || !all.back().empty()) {
            all.back() += c;
        }
    }
    for (std::string& element : all) {
        element.erase(element.find_last_not_of(' ') + 1);
    }
    return all;
}

std::string wrapped_array(std::string_view key, std::string_view value) {
    std::string text = fmt::format("{} = [\n", key);
    std::string line = "   ";
    for (const std::string& element : elements(value)) {
        if (line.size() + element.size() + 2 > kWidth && line.size() > 3) {
            text += line + "\n";
            line = "   ";
        }
        line += fmt::format(" {},", element);
    }
    return text + line + "\n]\n";
}

std::string wrapped_line(std::string_view line) {
    const std::size_t equals = line.find(" = ");
    if (line.size() <= kWidth || equals == std::string_view::npos) {
        return fmt::format("{}\n", line);
    }
    const std::string_view key = line.substr(0, equals), value = line.substr(equals + 3);
    if (value.front() == '[') {
        return wrapped_array(key, value);
    }
    if (value.front() != '{') {
        return fmt::format("{}\n", line);
    }
    std::string text;
    for (const std::string& element : elements(value)) {
        text += wrapped_line(fmt::format("{}.{}", key, element));
    }
    return text;
}

// The first screen: without headings. Without it, everything is printed.
struct Screen {
    std::set<std::string> shown;
    std::string heading;
    bool begins = false;             // the next entry is the first of its heading
    std::ptrdiff_t lines_left = 35;  // of 40, without the title and the last ones
};
std::optional<Screen> screen;

// Prints the lines of an entry, if the screen shows it and has room.
void print_under_heading(const std::string& name, const std::string& lines) {
    if (screen) {
        const bool shown = screen->shown.contains(screen->heading + ": " + name) ||
                           (!name.empty() && screen->shown.contains(screen->heading + ": *"));
        const auto count = std::ranges::count(lines, '\n') + (screen->begins ? 1 : 0);
        if (!shown || count > screen->lines_left) {
            return;
        }
        screen->lines_left -= count;
        fmt::print("{}", std::exchange(screen->begins, false) ? "\n" : "");
    }
    fmt::print("{}", lines);
}

// Formats seconds with two significant figures, or as whole seconds.
std::string seconds_text(double seconds) {
    return seconds < 0.01   ? "less than 0.01 s"
           : seconds < 9.95 ? fmt::format("{:.2g} s", seconds)
                            : fmt::format("{:.0f} s", seconds);
}

std::string percent(double change) {
    return change < 0.1 ? fmt::format("{:.2g} %", 100.0 * change)
                        : fmt::format("{:.0f} %", 100.0 * change);
}

std::string change_text(const MeasuredEffect& effect, const SolverFacts& facts, double tolerance) {
    if (!effect.refusal.empty()) {
        return "not measured: " + effect.refusal;
    }
    const int levels = static_cast<int>(facts.noise_levels.size());
    const double change = effect.change.largest_feature();
    const std::string& feature =
        facts.features[static_cast<std::size_t>(effect.change.worst_feature(levels))];
    std::string text = effect.in_study ? "simulated" : "omitted";
    if (!std::isfinite(change)) {
        text += effect.in_study ? "; without it gearboxes fail" : "; with it gearboxes fail";
    } else if (change > tolerance) {
        text += fmt::format("; {} {} by {}", effect.in_study ? "changes" : "would change", feature,
                            percent(change));
    } else {
        text += fmt::format(", not needed: {} by {}", feature, percent(change));
    }
    return text + fmt::format("; time x {:.2g}", effect.time_ratio);
}

// Describes how records at other torques or speeds are computed.
std::string load_text(const RecordDistribution& law, const LoadNumber& number, double tolerance) {
    const char* const unit = law.given() ? "the study's value" : "the gearbox's value";
    if (const std::vector<double> distinct = law.distinct_factors(); distinct.size() > 1) {
        return fmt::format(
            "{}; {} values occur, equally often, and each is integrated: {:.4g} "
            "times {}",
            law.text(), distinct.size(), fmt::join(distinct, ", "), unit);
    }
    const LoadAxis axis(law, number);
    return law.text() +
           (axis.factors().size() > 1
                ? fmt::format(
                      "; records between are interpolated from solutions at {:.3g} times {}{}",
                      fmt::join(axis.factors(), ", "), unit,
                      number.given ? ""
                                   : fmt::format(", or at more if the error is above {:g} "
                                                 "(life.interpolation_tolerance)",
                                                 tolerance))
                : "");
}

// Memory of a tile with so many lanes and loads, in bytes. For each load it holds the signals kept
// by the integration, and those without a crack and at the depths below and above. If only the
// perturbation due to the fault is integrated, the transmission errors of all meshes are added. A
// depth being integrated and tested adds two more. One gearbox also holds the folded products of
// its records.
double tile_bytes(const SolvePlan& solve, const RecordPlan& record, double lanes, double loads) {
    const double samples = static_cast<double>(record.span.meshes()) * record.samples;
    const double signals = (solve.perturbation_only ? 5.0 : 4.0) * loads + 2.0;
    const double basis = 3.0 * loads + 1.0;
    const double bins = static_cast<double>(record.span.planet_teeth) * record.samples;
    return 8.0 * (signals * lanes * samples + 0.5 * basis * (basis + 1.0) * bins) +
           solve.record_bytes;
}

double file_bytes(const CampaignPlan& campaign) {
    return 8.0 * static_cast<double>(lives_plan(campaign).rows()) *
           static_cast<double>(row_shape(lives_frame(campaign)).values() + 1);
}

std::string bytes_text(double bytes) {
    return bytes < 1e8 ? fmt::format("{:.2g} MB", bytes / 1e6)
                       : fmt::format("{:.0f} MB", bytes / 1e6);
}

// Numbers of torques and speeds with the most loads that may be chosen.
LifePlan with_most_loads(LifePlan plan) {
    if (plan.distributions.speed.varies() && !plan.speeds.given) {
        plan.speeds.nodes = kMostNodes;
    } else if (plan.distributions.torque.varies() && !plan.torques.given) {
        plan.torques.nodes = kMostNodes;
    }
    return plan;
}

// Size of the HDF5 file without its rows: names, attributes, the study's text, detection.
constexpr double kFrame_bytes = 45e3;

// Number of integrated tiles. Every rank caches only the solutions that it integrated itself.
IntegrationCounts integrations_of_ranks(const RunCost& cost, const BatchPlan& plan, int ranks) {
    IntegrationCounts counts = cost.integrations;
    const std::array<std::size_t, 2> gearboxes{plan.threshold_gearboxes(), plan.test_rows()};
    for (std::size_t g = 0; g < gearboxes.size(); ++g) {
        const std::size_t tiles = (gearboxes[g] + cost.lanes - 1) / cost.lanes;
        counts.integrated[g] =
            std::min(tiles, counts.integrated[g] * static_cast<std::size_t>(ranks));
    }
    return counts;
}

// Time limit for the trial gearboxes.
constexpr double kBudget_s = 1.0;

std::string measured_text(const RunCost& calibration) {
    std::string text =
        fmt::format("{} gearboxes in {:.1f} s",
                    std::ranges::count(calibration.gearboxes, 0U, &GearboxId::repeat),
                    calibration.wall_s + calibration.task_s);
    if (calibration.recorded < calibration.to_record) {
        text +=
            fmt::format(" over {} of {} mesh periods", calibration.recorded, calibration.to_record);
    }
    return text + "; the analysis by its number of values";
}

// Rows of the gearboxes computed to calibrate the forecast.
class CalibrationRows final : public RowSource {
  public:
    explicit CalibrationRows(const RunCost& calibration) : calibration_(calibration) {}
    std::size_t rows() const override { return calibration_.rows.count(); }
    void visit(const std::function<void(const RowBlock&)>& use) const override {
        RowBlock block{0, {}, calibration_.rows.status, calibration_.rows.values};
        for (const GearboxId& id : calibration_.gearboxes) {
            block.group.push_back(static_cast<int>(id.group));
        }
        use(block);
    }

  private:
    const RunCost& calibration_;
};

// Shares of the threads' time, with the same names as in the report of `run`.
std::string shares_text(const Seconds& work, double thread_s) {
    const auto share = [&](double seconds) { return 100.0 * seconds / std::max(1e-9, thread_s); };
    return fmt::format(
        "time integration {:.0f} %, stiffness {:.0f} %, signals {:.0f} %, noise {:.0f} %, "
        "features {:.0f} %",
        share(work.integration), share(work.stiffness + work.sampling), share(work.signals),
        share(work.noise), share(work.features));
}

// Formats a count with two significant figures.
std::string about(double count) {
    const double unit = std::pow(10.0, std::max(0.0, std::floor(std::log10(count)) - 1.0));
    return fmt::format("{:.0f}", unit * std::round(count / unit));
}

// Describes rank 0's work in addition to its own gearboxes.
std::string leader_text(const RankForecast& forecast) {
    const std::string most = about(std::max(1.0, forecast.bounding_ranks));
    return fmt::format("receives and writes {:.3g} batches per second, {:.2g} % of its time; {}",
                       forecast.batches_per_s, 100.0 * forecast.leader_share,
                       forecast.leader_share < 1.0
                           ? fmt::format("it would limit the speed from {} ranks on", most)
                           : fmt::format("it limits the speed from {} ranks on; split the run "
                                         "with --part, each part has its own rank 0",
                                         most));
}

void print_ranks(const RankForecast& forecast, int threads, int ranks) {
    print_heading("forecast for MPI ranks");
    print_entry("ranks", std::to_string(ranks));
    print_entry("threads", fmt::format("{} per rank, as here; {:.0f} have a batch of {} gearboxes "
                                       "to compute",
                                       threads, forecast.busy_threads, kBatchRows));
    print_entry("gearboxes", seconds_text(forecast.gearboxes_s));
    print_entry("estimated time", seconds_text(forecast.total_s));
    print_entry("estimated memory",
                fmt::format("{:.0f} MB per rank, {:.0f} MB for rank 0", forecast.rank_bytes / 1e6,
                            forecast.leader_bytes / 1e6));
    print_entry("estimated disk",
                fmt::format("checkpoint {:.3g} MB, results {:.3g} MB (twice that while the file "
                            "is rewritten)",
                            forecast.checkpoint_bytes / 1e6, forecast.results_bytes / 1e6));
    print_entry("rank 0", leader_text(forecast));
}

}  // namespace

void print_first_screen(std::set<std::string> shown) {
    screen.emplace().shown = std::move(shown);
}

void print_heading(const std::string& text) {
    if (screen) {
        screen->heading = text;
        screen->begins = true;
    } else {
        fmt::print("\n{}\n", text);
    }
}

void print_entry(const std::string& name, const std::string& value) {
    print_under_heading(name,
                        fmt::format("  {:<25} {}\n", name, wrapped_text(value, kValueColumn)));
}

void print_paragraph(const std::string& text) {
    print_under_heading("", fmt::format("  {}\n", wrapped_text(text, kTextColumn)));
}

void print_section(const DescriptionSection& section) {
    print_heading(section.heading);
    if (screen && screen->shown.contains(section.heading + ": names")) {
        std::set<std::string> names;
        for (const auto& [name, text] : section.entries) {
            names.insert(name);
        }
        names.erase("");
        print_under_heading(
            "names", fmt::format("  {}\n", wrapped_text(fmt::format("{}: {}", section.heading,
                                                                    fmt::join(names, ", ")),
                                                        kTextColumn + 2)));
        return;
    }
    for (const auto& [name, text] : section.entries) {
        name.empty() ? print_paragraph(text) : print_entry(name, text);
    }
}

std::string wrapped_study(std::string_view toml) {
    std::string text;
    while (!toml.empty()) {
        const std::size_t end = toml.find('\n');
        text += wrapped_line(toml.substr(0, end));
        toml.remove_prefix(end == std::string_view::npos ? toml.size() : end + 1);
    }
    return text;
}

void print_effect_changes(const Planner& planner, const signals::SpanLayout& span,
                          double mesh_frequency_Hz, double seconds) {
    const SolverFacts& facts = planner.facts();
    if (facts.features.empty()) {
        return;
    }
    const double tolerance =
        facts.numerics.tolerance > 0.0 ? facts.numerics.tolerance : kChangeOfFeature;
    const Planner brief = planner.with_short_records(span, mesh_frequency_Hz);
    bool begun = false;
    const EffectMeasurement all = measure_effects(
        brief, {.seconds = seconds, .measured = [&](const MeasuredEffect& effect) {
                    if (!begun) {
                        print_heading("what the effects change");
                        print_paragraph(fmt::format(
                            "measured on {} gearboxes to test, records of {}; not needed: no "
                            "feature changes by more than {:g} %",
                            lockstep::kPilotLanes,
                            record_length_text(brief.tile(brief.facts().numerics).record),
                            100.0 * tolerance));
                        begun = true;
                    }
                    print_entry(effect.effect, change_text(effect, facts, tolerance));
                }});
    if (!all.omitted.empty()) {
        print_entry(
            "not measured",
            fmt::format(
                "{}: the time was used up (--seconds; gearpod accuracy measures all of them)",
                fmt::join(all.omitted, ", ")));
    }
}

void print_life(const StudyLives& lives) {
    if (!lives.requested) {
        return;
    }
    print_heading("lives");
    if (!lives.problems.empty()) {
        for (const SceneError& problem : lives.problems) {
            print_entry("refused by `lives`",
                        fmt::format("{}: {}; {}", problem.key(), problem.what(), problem.remedy()));
        }
        return;
    }
    const LifePlan& plan = *lives.plan;
    const RecordDistributions& laws = plan.distributions;
    print_entry("record", plan.record);
    print_entry("random per gearbox",
                plan.gearbox_inputs.empty()
                    ? "nothing: all gearboxes are identical"
                    : fmt::format("{}", fmt::join(plan.gearbox_inputs, ", ")));
    print_entry("torque per record",
                load_text(laws.torque, plan.torques, plan.interpolation_tolerance));
    print_entry("speed per record",
                load_text(laws.speed, plan.speeds, plan.interpolation_tolerance));
    print_entry("gain per record", laws.gain.text());
    print_entry("noise per record", laws.noise.text());
    std::string growth = std::holds_alternative<ParisStart>(plan.growth)
                             ? "Paris law, with the torque and speed of the records"
                             : "along the given curve";
    for (const std::string& key : plan.ignored_inputs) {
        growth += "; " + key + " in [random] is ignored";
    }
    print_entry("crack growth", growth);
    const CampaignPlan& campaign = plan.campaign;
    print_entry("crack depths integrated",
                fmt::format("0 and {} depths up to {:g} mm, with interpolation in between",
                            campaign.depth_steps, 1e3 * campaign.last_m));
    print_entry("gearboxes",
                fmt::format("{} with a crack, {} healthy for the thresholds, {} "
                            "healthy to count false alarms",
                            campaign.ensemble.test_gearboxes, campaign.ensemble.threshold_gearboxes,
                            campaign.counting_lives));
}

LivesForecast forecast_lives(const LifeTiles& tiles, int threads, double setup_s, int pilot_loads) {
    const SolvePlan& solve = *tiles.tile().solve;
    const RecordPlan& record = tiles.tile().record;
    const CampaignPlan& campaign = tiles.plan().campaign;
    const BatchPlan plan = lives_plan(campaign);
    const auto lanes = static_cast<double>(tiles.lanes()),
               loads = static_cast<double>(tiles.load_count());
    LivesForecast all;
    all.threads = std::max(1, std::min(threads, static_cast<int>(plan.batches())));
    all.setup_s = setup_s;
    // Mean number of records until the end of life, and of depths at which a tile is integrated,
    // over the first gearboxes with a crack.
    constexpr std::uint64_t kMostLives = 64;
    const auto lives = std::clamp<std::uint64_t>(
        static_cast<std::uint64_t>(campaign.ensemble.test_gearboxes), 1, kMostLives);
    std::vector<LifeHistory> histories;
    std::vector<const LifeHistory*> pointers;
    double cracked_records = 0.0;
    for (std::uint64_t i = 0; i < lives; ++i) {
        histories.push_back(tiles.history({Group::test, i}));
        cracked_records +=
            static_cast<double>(histories.back().records.size()) / static_cast<double>(lives);
    }
    for (const LifeHistory& history : histories) {
        pointers.push_back(&history);
    }
    all.crack_records = crack_records_text(pointers);
    double depths[2]{};  // [1]: of tiles that measure the interpolation error
    for (std::size_t first = 0; first < pointers.size(); first += tiles.lanes()) {
        const auto tile = std::span<const LifeHistory* const>(pointers).subspan(
            first, std::min(tiles.lanes(), pointers.size() - first));
        for (const bool tested : {false, true}) {
            const std::vector<bool> integrated = tiles.integrated_depths(tile, tested);
            depths[tested ? 1 : 0] +=
                static_cast<double>(std::count(integrated.begin() + 1, integrated.end(), true)) /
                std::ceil(static_cast<double>(lives) / lanes);
        }
    }
    // Mesh periods of a tile without a fault, and the additional ones of each crack depth.
    const double healthy_meshes = solve.integrated_meshes,
                 depth_meshes = solve.perturbation_only ? solve.passage_meshes : healthy_meshes;
    const double mesh_s = mesh_period_s(tiles.tile().draw(), *tiles.tile().gearbox, solve, record);
    const auto tile_s = [&](bool cracked, bool tested) {
        double meshes = loads * healthy_meshes;
        if (cracked) {
            meshes += loads * depths[tested ? 1 : 0] * depth_meshes;
        }
        if (tested) {
            meshes += 2.0 * depth_meshes + static_cast<double>(tiles.gap_count()) * healthy_meshes;
        }
        return meshes * mesh_s;
    };
    const RecordTimes trial = tiles.time_records();
    std::vector<double> busy_s(static_cast<std::size_t>(all.threads), 0.0);
    double integrating_s = 0.0, records_s = 0.0, record_count = 0.0;
    for (std::size_t b = 0; b < plan.batches(); ++b) {
        const Batch batch = plan.batch(b);
        const bool cracked = batch.group == Group::test;
        const double records = cracked ? cracked_records : campaign.records;
        double batch_s = 0.0;
        for (std::size_t first = 0; first < batch.gearboxes; first += tiles.lanes()) {
            const bool tested = measures_interpolation({batch.group, batch.first_index + first});
            batch_s += tile_s(cracked, tested);
        }
        integrating_s += batch_s;
        const double tile_records_s =
            static_cast<double>(batch.gearboxes) *
            (records * trial.record_s + (cracked ? campaign.depth_steps : 1) * trial.step_s);
        record_count += static_cast<double>(batch.gearboxes) * records;
        records_s += tile_records_s;
        *std::ranges::min_element(busy_s) += batch_s + tile_records_s;
    }
    const double pilot_tiles = std::ceil(static_cast<double>(kInterpolationPilots) / lanes);
    all.pilots_s = pilot_loads == 0
                       ? 0.0
                       : mesh_s * pilot_tiles * (pilot_loads * healthy_meshes + depth_meshes);
    all.processor_s = all.pilots_s + integrating_s + records_s;
    all.gearboxes = static_cast<long>(plan.rows());
    all.records = std::lround(record_count);
    all.gearbox_s = integrating_s / static_cast<double>(std::max<std::size_t>(1, plan.rows()));
    all.record_s = records_s / std::max(1.0, record_count);
    all.integration_s = std::ranges::max(busy_s);
    all.file_bytes = file_bytes(campaign);
    all.memory_bytes = peak_memory_bytes() + all.threads * tile_bytes(solve, record, lanes, loads) +
                       all.file_bytes;
    return all;
}

void print_lives_forecast(const TilePlan& tile, const LifePlan& plan, double setup_s, int ranks,
                          bool chooses) {
    constexpr double kMostPilots_s = 5.0;
    // Torques and speeds that pilots examine.
    const auto interpolated = [](const RecordDistribution& quantity) {
        return quantity.varies() && quantity.distinct_factors().empty() ? 1 : 0;
    };
    const int axes =
        interpolated(plan.distributions.torque) + interpolated(plan.distributions.speed);
    const int threads = thread_count(plan.campaign.ensemble);
    // One load and five more for each quantity that varies are integrated at least.
    const int least_loads = axes == 0 ? 0 : 1 + 5 * axes;
    LivesForecast all = forecast_lives(LifeTiles(tile, plan), threads, setup_s, least_loads);
    std::string loads, most;
    if (chooses && axes > 0 && all.pilots_s <= kMostPilots_s) {
        const InterpolationChoice choice = choose_interpolation(tile, plan);
        const LifeTiles tiles(tile, choice.plan);
        all = forecast_lives(tiles, threads, setup_s, choice.loads);
        loads = fmt::format("{}; pilots are off by {:.2g} of what a crack of {:g} mm changes",
                            tiles.load_count(), choice.error, 1e3 * plan.campaign.smallest_m);
    } else if (const LifePlan most_loads = with_most_loads(plan);
               axes > 0 && most_loads.torques == plan.torques && most_loads.speeds == plan.speeds) {
        loads = fmt::format("{}; pilots measure the error when the run starts",
                            LifeTiles(tile, plan).load_count());
    } else if (axes > 0) {
        const LifeTiles tiles(tile, most_loads);
        const LivesForecast upper =
            forecast_lives(tiles, threads, setup_s, static_cast<int>(kMostLoads));
        loads = fmt::format("at least {}, at most {}: chosen when the run starts",
                            LifeTiles(tile, plan).load_count(), tiles.load_count());
        most = ", at most " + seconds_text(upper.total_s());
    }
    print_heading("forecast of lives");
    print_entry("based on",
                "the time of one mesh period, the number of mesh periods that the damping "
                "requires, and records of artificial signals");
    print_entry("threads", fmt::format("{}, {}", all.threads,
                                       machine::name(machine::active_instruction_set())));
    print_entry("set-up", seconds_text(all.setup_s));
    if (!loads.empty()) {
        print_entry("integrated loads", loads);
        print_entry("pilots", seconds_text(all.pilots_s) + " on one thread");
    }
    print_entry("gearboxes", fmt::format("{}, time integration {:.2g} s of processor time each",
                                         all.gearboxes, all.gearbox_s));
    print_entry("records", fmt::format("{}, superposition {:.2g} ms of processor time each",
                                       all.records, 1e3 * all.record_s));
    print_entry("records of a crack",
                all.crack_records + ", from its start to the failure of its tooth");
    print_entry("processor time", seconds_text(all.processor_s));
    print_entry("estimated time", seconds_text(all.total_s()) + most);
    print_entry("estimated memory", bytes_text(all.memory_bytes));
    print_entry("results file",
                bytes_text(all.file_bytes) + "; the checkpoint is as large until the run ends");
    if (ranks > 0) {
        print_entry(fmt::format("with {} MPI ranks", ranks),
                    seconds_text(
                        forecast_lives(LifeTiles(tile, plan), threads * ranks, setup_s, least_loads)
                            .total_s()));
    }
}

double checkpoint_bytes(const BatchPlan& plan, const RowShape& shape) {
    // Each batch has a mark, a count and a checksum; each row has a status
    // (docs/reference/results-file.md).
    const double row = 8.0 * (1.0 + static_cast<double>(shape.values()));
    const auto healthy = static_cast<double>(plan.threshold_batches() * plan.threshold_records());
    const auto test = static_cast<double>(plan.batches() - plan.threshold_batches());
    return 24.0 * static_cast<double>(plan.batches()) + kBatchRows * row * (healthy + test);
}

double results_bytes(const BatchPlan& plan, const RowShape& shape) {
    // Each row also has a group and a status.
    return kFrame_bytes +
           static_cast<double>(plan.rows()) * 8.0 * (2.0 + static_cast<double>(shape.values()));
}

double leader_time_s(double batch_bytes) {
    constexpr double kBatch_s = 14e-6, kByte_s = 2.2e-9;
    return kBatch_s + kByte_s * batch_bytes;
}

RankForecast forecast_ranks(const RunCost& calibration, const BatchPlan& plan,
                            const RowShape& shape, const RunForecast& alone, int ranks) {
    const IntegrationCounts integrations = integrations_of_ranks(calibration, plan, ranks);
    const double motion = calibration.motion_bytes;
    const auto batches = static_cast<double>(plan.batches());

    RankForecast forecast;
    RunCost all = calibration;
    all.threads = static_cast<int>(
        std::min(static_cast<double>(calibration.threads) * ranks, std::max(1.0, batches)));
    forecast.busy_threads = all.threads;
    forecast.checkpoint_bytes = checkpoint_bytes(plan, shape);
    forecast.results_bytes = results_bytes(plan, shape);

    const double computing_s = gearboxes_s(all, plan, integrations);
    const double leading_s =
        batches * leader_time_s(forecast.checkpoint_bytes / std::max(1.0, batches));
    forecast.gearboxes_s = std::max(computing_s, leading_s);
    forecast.total_s = alone.setup_s + forecast.gearboxes_s + alone.detection_s;
    forecast.batches_per_s = batches / forecast.gearboxes_s;
    forecast.leader_share = leading_s / forecast.gearboxes_s;
    // Number of ranks that together finish a batch in the time that rank 0 needs to receive one.
    const double thread_s =
        gearboxes_s(calibration, plan, calibration.integrations) * calibration.threads;
    forecast.bounding_ranks = thread_s / leading_s / calibration.threads;
    forecast.rank_bytes = memory_bytes(calibration.memory, integrations, motion, 0.0);
    forecast.leader_bytes =
        memory_bytes(calibration.memory, integrations, motion, assessment_bytes(shape, plan));
    return forecast;
}

namespace {

// Processor seconds of one thread to integrate the records of a tile.
double tile_integration_s(const TilePlan& tile) {
    return tile.solve->integrated_meshes *
           mesh_period_s(tile.draw(), *tile.gearbox, *tile.solve, tile.record);
}

}  // namespace

void print_step_forecast(const TilePlan& tile, const EnsemblePlan& ensemble,
                         const PeakMemory& memory) {
    const BatchPlan plan = ensemble.batches();
    const auto threads =
        std::min(static_cast<std::size_t>(std::max(1, thread_count(ensemble))), plan.batches());
    print_heading("forecast of a run");
    print_entry(
        "based on",
        fmt::format("the number of gearboxes and time steps and the time of one mesh period alone; "
                    "signals, features, analysis, and gearboxes that cannot be superposed take "
                    "more. Raise --seconds to compute some gearboxes instead"));
    print_entry("threads", std::to_string(threads));
    if (tile.solve->settings.quasi_static) {
        print_entry("estimated time", "not forecast: a quasi-static study integrates nothing");
    } else {
        const auto lanes = static_cast<double>(ensemble.lanes);
        const double tiles = std::ceil(static_cast<double>(plan.threshold_gearboxes()) / lanes) +
                             std::ceil(static_cast<double>(plan.test_rows()) / lanes);
        const double meshes = tile.solve->integrated_meshes;
        // Baseline records are integrated like the test record, and each with its own neighbours.
        const auto records = static_cast<double>(1 + tile.record.computed_baselines);
        double record_s = tile_integration_s(tile);
        for (const StagePlan& stage : tile.gearbox->stages) {
            record_s += tile_integration_s(*stage.tile) * lanes /
                        stage.tile->solve->settings.numerics.lanes;
        }
        print_entry(
            "time integration",
            fmt::format(
                "at least {}: {:.0f} tiles of {} gearboxes with {:.0f} record{} each, about "
                "{:.0f} mesh periods of {} steps for each",
                seconds_text(tiles * records * record_s / static_cast<double>(threads)), tiles,
                ensemble.lanes, records, records == 1.0 ? "" : "s", meshes,
                tile.solve->integration().grid.steps.size()));
    }
    const double least_bytes =
        std::max(memory.setup_bytes + least_memory_bytes(motion_bytes(tile), ensemble.shape, plan,
                                                         static_cast<int>(threads)),
                 memory.computed_bytes);
    print_entry("memory", fmt::format("at least {:.0f} MB", least_bytes / 1e6));
}

void print_forecast(const Scene& scene, const Planner& planner, double setup_s, int ranks) {
    const EnsemblePlan& ensemble = scene.ensemble();
    const BatchPlan plan = ensemble.batches();
    const int threads = thread_count(ensemble);
    const RunCost calibration = measure_run_cost(scene.tile(), ensemble, plan, threads, kBudget_s);
    const bool chosen = scene.solve().settings.numerics.scatter_tolerance > 0.0;
    const RunForecast forecast = forecast_run(
        calibration, ensemble.shape, plan,
        verification_s(planner, calibration, chosen) + assumptions_s(planner, calibration),
        setup_s);
    if (!ensemble.meshes.empty()) {
        print_heading("contact");
    }
    if (const std::string loss = contact_loss_text(
            summarise_contact_loss(results_frame(ensemble), CalibrationRows(calibration)));
        !loss.empty()) {
        print_entry("out of contact",
                    fmt::format("{} of the time of a tooth pair: mean (5 to 95 % range of {} "
                                "gearboxes)",
                                loss, calibration.rows.count()));
    }
    if (!ensemble.meshes.empty() && !scene.solve().settings.quasi_static) {
        constexpr double kMost_s = 1.0;
        const auto error = find_step_error(
            planner,
            kMost_s / mesh_period_s(scene.draw(), scene.gearbox(), scene.solve(), scene.record()));
        print_entry("time step error",
                    error ? step_error_text(*error)
                          : "not measured, because it would take too long; contact loss lowers "
                            "the order of the method");
    }
    print_heading("forecast of a run");
    print_entry("based on", measured_text(calibration));
    print_entry("threads", fmt::format("{}, {}", calibration.threads,
                                       machine::name(machine::active_instruction_set())));
    print_entry("set-up", seconds_text(forecast.setup_s));
    print_entry("gearboxes", fmt::format("{}: {}", seconds_text(forecast.gearboxes_s),
                                         shares_text(forecast.work,
                                                     forecast.gearboxes_s * calibration.threads)));
    print_entry("detection and results", seconds_text(forecast.detection_s));
    print_entry("estimated time", seconds_text(forecast.total_s()));
    print_entry("estimated memory", fmt::format("{:.0f} MB", forecast.memory_bytes / 1e6));
    if (ranks > 0) {
        print_ranks(forecast_ranks(calibration, plan, ensemble.shape, forecast, ranks),
                    calibration.threads, ranks);
    }
}

}  // namespace gearpod::mc
