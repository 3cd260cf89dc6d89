// Checks mean baselines, averages and sustained alarms of synthetic recordings with a known truth:
// noise, any start angle, a gain that drifts by 20 %, and corrupt recordings.
#include "mc/numerics/numerics_choice.hpp"
#include "mc/recordings/recording_baselines.hpp"
#include "signals/spectra/alignment.hpp"
#include "tests/mc/recording_files.hpp"

namespace gearpod::test_recording_baselines {

using namespace test;

constexpr int kTeeth = 11, kPerMesh = 8, kSamples = kTeeth * kPerMesh;
constexpr int kFaultyTooth = 7;

// One planet turn with orders 1 to 40, sampled from any start angle.
class Machine {
  public:
    Machine() {
        std::uniform_real_distribution<double> phase(0.0, 2.0 * std::numbers::pi);
        for (int k = 1; k <= 40; ++k) {
            amplitude_.push_back(1.0 / std::sqrt(20.0));
            phase_.push_back(phase(engine_));
        }
    }
    // RMS 1 times the gain, noise of RMS 0.4, and at the fault's tooth a burst of this height.
    std::vector<double> record(double gain, double fault) {
        std::uniform_real_distribution<double> start(0.0, kSamples);
        std::normal_distribution<double> normal(0.0, 0.4);
        const double begin = start(engine_);
        return test::tabulated(kSamples, [&](int i) {
            return gain * healthy(i + begin) + fault * burst(i + begin) + normal(engine_);
        });
    }
    std::vector<double> corrupt() {
        std::normal_distribution<double> normal(0.0, 5.0);
        return test::tabulated(kSamples, [&](auto) { return normal(engine_); });
    }
    std::vector<double> truth() const {
        return test::tabulated(kSamples, [&](int i) { return healthy(i); });
    }

  private:
    double healthy(double at) const {
        double sum = 0.0;
        for (std::size_t k = 0; k < amplitude_.size(); ++k) {
            const double order = static_cast<double>(k + 1);
            sum += amplitude_[k] *
                   std::cos(2.0 * std::numbers::pi * order * at / kSamples + phase_[k]);
        }
        return sum;
    }
    static double burst(double at) {
        const double middle = (kFaultyTooth - 0.5) * kPerMesh;
        double away = std::fmod(at - middle, static_cast<double>(kSamples));
        away = std::min(std::abs(away), kSamples - std::abs(away));
        return std::exp(-0.5 * away * away / 2.0) * std::cos(1.5 * away);
    }
    std::mt19937_64 engine_{11};
    std::vector<double> amplitude_, phase_;
};

mc::MeasuredSignal signal_of(std::vector<double> samples) {
    mc::MeasuredSignal signal;
    signal.sensor = std::move(samples);
    signal.has_sensor = true;
    signal.sensor_meshes = kTeeth;
    return signal;
}

TEST_CASE(
    "Recordings with noise, any start and a drifting gain are aligned, a corrupt one is not") {
    auto study = mc::make_scene(kSmallStudy, mc::read_study(kSmallStudy, {}));
    REQUIRE(study.scene);
    Machine machine;
    mc::RecordingList list;
    mc::RecordingGroup group{"baseline", {}, {}};
    std::vector<mc::MeasuredSignal> members;
    for (std::size_t i = 0; i < 20; ++i) {
        list.recordings.push_back({});
        list.recordings.back().file = "r" + std::to_string(i);
        group.chosen.push_back(i);
        members.push_back(signal_of(i == 0 ? machine.corrupt() : machine.record(1.0, 0.0)));
    }
    std::vector<std::string> notes;
    const mc::GroupBaseline baseline(group, list, members, study.scene->record(), false, notes);
    REQUIRE(baseline.refusal().empty());
    CHECK(baseline.members() == 19);
    REQUIRE(notes.size() == 1);
    CHECK_THAT(notes[0], Catch::Contains("r0: left out of the baseline"));
    // Where the baseline starts in the machine's own angle.
    const auto mean = baseline.without({}).signal.sensor;
    const auto start = signals::align(mean, machine.truth());
    CHECK(start.correlation > 0.99);
    const auto truth = signals::shifted(machine.truth(), start.shift);
    int right = 0;
    constexpr int kRecords = 500;
    for (int i = 0; i < kRecords; ++i) {
        const double gain = 1.0 + 0.2 * i / kRecords;
        const auto aligned =
            baseline.aligned(signal_of(machine.record(gain, 0.0)), study.scene->record());
        // Noise alone leaves 1 / sqrt(1 + 0.16) = 0.93; a start of another tooth below 0.6.
        right += signals::correlation(truth, aligned.sensor) > 0.85 ? 1 : 0;
    }
    CHECK(right >= kRecords * 99 / 100);
    CHECK_THROWS_WITH(
        baseline.aligned(signal_of(std::vector<double>(kSamples, 1.0)), study.scene->record()),
        Catch::Contains("does not resemble"));
    // A recording of the baseline is compared with the others only.
    const std::vector<std::size_t> third{3};
    const auto others = baseline.without(third).signal.sensor;
    const auto own = baseline.aligned(members[3], study.scene->record()).sensor;
    for (std::size_t s = 0; s < others.size(); ++s) {
        CHECK(18.0 * others[s] + own[s] == Approx(19.0 * mean[s]).margin(1e-6));
    }
}

struct Recorded {
    Folder folder;
    std::string manifest, results;
    static constexpr int kHealthy = 120, kAll = 200, kCorrupt = 60;

    Recorded() : manifest(folder.file("m.csv")), results(folder.file("r.h5")) {
        Machine machine;
        std::ofstream table(manifest);
        table << "file,gearbox,time [day],label,load\n";
        for (int i = 0; i < kAll; ++i) {
            const std::string name = "r" + std::to_string(i) + ".csv";
            const double fault = std::max(0.0, 6.0 * (i - kHealthy) / (kAll - kHealthy));
            const auto samples = i == kCorrupt || i == 170
                                     ? machine.corrupt()
                                     : machine.record(1.0 + 0.2 * i / kAll, fault);
            write_csv(folder.file(name), "sensor [m/s^2]", {samples});
            table << name << ",A," << 0.1 * i << "," << (i < kHealthy ? "healthy" : "faulty") << ","
                  << i % 2 << "\n";
        }
    }
    Outcome features(const std::string& options) const {
        return program("features --manifest " + manifest + " --study " + kSmallStudy +
                       " --samples-per-mesh 8 --quiet --set detection.false_alarm_rate=0.01 " +
                       "--set 'features.use=[\"change_kurtosis\",\"baseline_correlation\"]' " +
                       options);
    }
};

TEST_CASE("A fault sustains an alarm at its tooth, and a corrupt recording does not") {
    const Recorded recorded;
    const Outcome measured =
        recorded.features("--baseline-records 20 --average 5 --out " + recorded.results);
    INFO(measured.output);
    REQUIRE((measured.code == 0 || measured.code == 3));
    CHECK(measured.mentions("baseline of gearbox A: mean of 20 recordings"));
    const auto monitoring = json_of("report " + recorded.results + " --json -")["monitoring"];
    // 100 healthy recordings: at most 1 in 101.
    CHECK(monitoring["smallest_rate"].get<double>() <= 1.0 / 99.0);
    bool found = false;
    for (const auto& one : monitoring["watched"]) {
        if (one["feature"] != "change_kurtosis" || one["detector"] != "single") {
            continue;
        }
        found = true;
        CHECK(one["healthy"]["sustained"] == 0);
        const auto& gearbox = one["gearboxes"][0];
        REQUIRE(!gearbox["sustained"].is_null());
        // The burst is as large as the healthy signal's RMS after 13 recordings of 80.
        CHECK(gearbox["sustained"]["time"].get<double>() < 0.1 * 165);
        CHECK(gearbox["sustained"]["time"].get<double>() >= 0.1 * Recorded::kHealthy);
        CHECK(gearbox["sustained"]["recordings_left"].get<long>() > 30);
        CHECK(gearbox["tooth"]["same"].get<double>() >=
              0.9 * gearbox["tooth"]["recordings"].get<double>());
    }
    CHECK(found);
    REQUIRE(monitoring["recordings"].size() == 1);
    const auto& series = monitoring["recordings"][0];
    CHECK(series["tooth_rms"].back().size() == kTeeth);
    // The healthy recordings' gain rises by a tenth, for which the threshold of the level allows.
    for (const auto& one : monitoring["watched"]) {
        if (one["feature"] == "sensor_rms" && one["detector"] == "single") {
            CHECK(one["healthy"]["drift"].get<double>() > 0.5);
            CHECK(one["healthy"]["alarms"] == 0);
        }
    }
    CHECK(program("report " + recorded.results).mentions("A: change_kurtosis (single): sustained"));
}

double largest(const std::string& csv, const std::string& column) {
    std::istringstream stream(csv);
    std::string line, field;
    std::getline(stream, line);
    std::istringstream head(line);
    int at = -1, place = 0;
    for (; std::getline(head, field, ','); ++place) {
        at = field == column ? place : at;
    }
    REQUIRE(at >= 0);
    double found = 0.0;
    for (int row = 0; std::getline(stream, line) && row < Recorded::kHealthy; ++row) {
        std::istringstream cells(line);
        for (int c = 0; std::getline(cells, field, ',') && c < at; ++c) {
        }
        // After the baseline, whose first averages are of fewer, and without those of the corrupt
        // one.
        const bool used = row >= 20 && (row < Recorded::kCorrupt || row > Recorded::kCorrupt + 4);
        found = used && !field.empty() ? std::max(found, std::stod(field)) : found;
    }
    return found;
}

TEST_CASE("Scaling removes the drift of the gain, and averaging lowers the noise of the change") {
    const Recorded recorded;
    const auto csv = [&](const std::string& options) {
        const Outcome outcome =
            recorded.features("--csv " + recorded.folder.file("f.csv") + " " + options);
        INFO(outcome.output);
        REQUIRE((outcome.code == 0 || outcome.code == 3));
        std::ifstream stream(recorded.folder.file("f.csv"));
        return std::string(std::istreambuf_iterator<char>(stream), {});
    };
    const std::string rms = "change_sensor_rms [m/s^2]";
    const double single = largest(csv("--baseline-records 20"), rms);
    const double averaged = largest(csv("--baseline-records 20 --average 5"), rms);
    const double scaled =
        largest(csv("--baseline-records 20 --average 5 --baseline-scale fit"), rms);
    CHECK(averaged < 0.75 * single);
    CHECK(scaled < averaged);
    // Conditions: two baselines, each of its own recordings.
    check_mentions(recorded.features("--baseline-records 10 --baseline-by load --csv " +
                                     recorded.folder.file("f.csv")),
                   {"baseline of gearbox A at load 0: mean of 10 recordings",
                    "baseline of gearbox A at load 1: mean of 10 recordings"});
}

TEST_CASE("Bad combinations of baseline options are refused with all reasons") {
    const Recorded recorded;
    const std::string csv = "--csv " + recorded.folder.file("f.csv") + " ";
    check_refused(recorded.features(csv + "--average 5 --baseline-by torque"),
                  {"no baseline is given to align them with",
                   "--baseline-by torque: the manifest has no such operating condition"});
    check_refused(recorded.features(csv + "--baseline-records 1"),
                  {"a mean has at least two recordings"});
    check_refused(recorded.features(csv + "--baseline-records 20 --baseline " +
                                    recorded.folder.file("r0.csv")),
                  {"give one baseline"});
    write_bytes(recorded.folder.file("marked.csv"),
                "file,label,baseline\nr1.csv,healthy,yes\nr2.csv,healthy,maybe\n"
                "r199.csv,faulty,yes\n");
    check_refused("features --manifest " + recorded.folder.file("marked.csv") + " --study " +
                      kSmallStudy + " --samples-per-mesh 8 --csv -",
                  {"\"maybe\" is neither yes nor no", "is yes for a faulty recording"});
}

TEST_CASE("Stronger lines of another stage do not decide how recordings are aligned") {
    const signals::SpanLayout span{11, 26, 26};
    const int samples = span.meshes() * kPerMesh;
    std::mt19937_64 engine(3);
    std::uniform_real_distribution<double> phase(0.0, 2.0 * std::numbers::pi);
    std::map<int, double> lines;  // of the planet (26 turns) and of the ring (11 turns)
    for (int k = 1; k <= 20; ++k) {
        lines[26 * k] = phase(engine);
        lines[11 * k] = phase(engine);
    }
    const auto record = [&](double meshes) {
        std::vector<double> signal;
        for (int i = 0; i < samples; ++i) {
            const double turn = 2.0 * std::numbers::pi / samples;
            double value = 0.0;
            for (const int order : {307, 613, 921, 1123}) {  // at the same phase in all recordings
                value += 10.0 * std::cos(turn * order * i);
            }
            for (const auto& [order, start] : lines) {
                value += std::cos(turn * order * (i + meshes * kPerMesh) + start);
            }
            signal.push_back(value);
        }
        return signal;
    };
    const auto first = record(0.0), later = record(12.3);
    const auto error = [&](const signals::Shift& shift) {  // in samples
        return std::abs(std::remainder(shift.total() + 12.3 * kPerMesh, samples));
    };
    CHECK(error(signals::align(first, later).shift) > kPerMesh);
    const auto aligned = mc::aligned_with(first, later, span.ring_teeth, span);
    CHECK(aligned.correlation > 0.999);
    CHECK(error(aligned.shift) < 1e-6);
}

}  // namespace gearpod::test_recording_baselines
