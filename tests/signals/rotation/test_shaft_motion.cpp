// Checks that jumps of a measured rotation are found, and that rotation of real gearboxes passes:
// jittery, quantized, with torsional vibration, run-ups and few pulses.
#include "signals/rotation/shaft_motion.hpp"
#include "tests/test.hpp"

namespace gearpod::test_shaft_motion {

constexpr double kTurn = 2.0 * std::numbers::pi, kRate_Hz = 5120.0;
constexpr double kLeast = 0.05 / 76.0 * kTurn;  // rad
constexpr std::size_t kCount = 20000;

using Motion = std::function<double(double)>;  // turns at a time

std::vector<double> angles(const Motion& turns, const std::function<double(double)>& read,
                           double jump = 0.0, std::size_t at = kCount) {
    std::vector<double> all;
    for (std::size_t i = 0; i < kCount; ++i) {
        const double angle = turns(static_cast<double>(i) / kRate_Hz) + (i >= at ? jump : 0.0);
        all.push_back(read(angle) * kTurn);
    }
    return all;
}

double exact(double angle) {
    return angle;
}
double wrapped(double angle) {
    return angle - std::floor(angle);
}
std::function<double(double)> counts(double per_turn) {
    return [per_turn](double angle) { return std::floor(angle * per_turn) / per_turn; };
}

double steady(double t) {
    return 0.3 + t;
}
double fast(double t) {
    return 25.0 * t;
}
double torsional(double t) {
    return t + 0.02 * std::sin(kTurn * 3.0 * t) + 2e-4 * std::sin(kTurn * 76.0 * t);
}
// Strong vibration at 900 Hz, nearly to a standstill.
double ringing(double t) {
    return 2.0 * t + 3e-4 * std::sin(kTurn * 900.0 * t);
}
double run_up(double t) {
    return 0.01 * t + 2.0 * t * t;
}
// Torque that is removed in one step: a tenth slower from one sample to the next.
double load_step(double t) {
    return t < 2.0 ? t : 2.0 + 0.9 * (t - 2.0);
}
// Speed that drops to a third during a few samples at each of 20 impacts per turn.
double impacts(double t) {
    const double phase = 20.0 * t - std::floor(20.0 * t);
    return t - 1e-4 * std::exp(-phase * 40.0) * (1.0 - std::exp(-phase * 400.0));
}

TEST_CASE("rotation of real gearboxes passes as it is read") {
    const std::pair<const char*, Motion> motions[] = {
        {"steady", steady},   {"fast", fast},     {"torsional", torsional},
        {"ringing", ringing}, {"run-up", run_up}, {"load step", load_step},
        {"impacts", impacts}};
    const std::pair<const char*, std::function<double(double)>> readings[] = {
        {"exact", exact},
        {"wrapped", wrapped},
        {"8 counts", counts(8)},
        {"60 counts", counts(60)},
        {"360 counts", counts(360)},
        {"1024 counts", counts(1024)},
        {"2048 counts", counts(2048)},
        {"5000 counts", counts(5000)},
        {"65536 counts", counts(65536)},
        {"2^20 counts", counts(1048576)}};
    for (const auto& [motion, turns] : motions) {
        for (const auto& [reading, read] : readings) {
            INFO(motion << ", " << reading);
            const signals::ShaftAngle angle = signals::shaft_angle(angles(turns, read), kLeast);
            CHECK(angle.problem == "");
        }
    }
}

TEST_CASE("jitter up to half a step passes") {
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    for (const double jitter : {0.01, 0.1}) {
        std::vector<double> all = angles(fast, exact);
        const double step = all[1] - all[0];
        for (double& value : all) {
            value += std::clamp(jitter * normal(random), -0.49, 0.49) * step;
        }
        CHECK(signals::shaft_angle(all, kLeast).problem == "");
    }
}

TEST_CASE("a jump ahead is found in every motion, with its size and its sample") {
    const std::pair<const char*, Motion> motions[] = {
        {"steady", steady}, {"torsional", torsional}, {"load step", load_step}};
    for (const auto& [motion, turns] : motions) {
        for (const double jump : {0.005, 0.02, 0.1, 0.3, 0.49}) {
            for (const std::size_t at : {100UL, 9000UL, 19900UL}) {
                INFO(motion << " " << jump << " " << at);
                const auto found = signals::shaft_angle(angles(turns, exact, jump, at), kLeast);
                CHECK_THAT(found.problem, Catch::Contains("jumps ahead by"));
                CHECK(found.problem_sample == at + 1);
                if (at == 9000) {  // counts of a fifth of the jump
                    const auto coarse =
                        signals::shaft_angle(angles(turns, counts(5.0 / jump), jump, at), kLeast);
                    CHECK_THAT(coarse.problem, Catch::Contains("jumps ahead by"));
                }
            }
        }
    }
    const auto found = signals::shaft_angle(angles(steady, wrapped, 0.1, 9000), kLeast);
    CHECK_THAT(found.problem, Catch::Contains("by 0.1 turn at sample 9001"));
    // Half of a step: 200 samples per turn.
    CHECK(signals::shaft_angle(angles(fast, exact, 0.005, 9000), kLeast).problem_sample == 9001);
}

TEST_CASE("several jumps are found") {
    std::vector<double> all = angles(steady, exact);
    for (std::size_t i = 0; i < kCount; ++i) {
        all[i] += 0.02 * kTurn * std::floor(static_cast<double>(i) / 900.0);
    }
    CHECK(signals::shaft_angle(all, kLeast).problem_sample == 901);
}

TEST_CASE("jumps below the documented limits pass") {
    // 0.02 mesh periods, and less than a fifth of a step.
    CHECK(signals::shaft_angle(angles(steady, exact, 0.02 / 76.0, 9000), kLeast).problem == "");
    CHECK(signals::shaft_angle(angles(fast, exact, 0.1 * 25.0 / kRate_Hz, 9000), 0.0).problem ==
          "");
}

TEST_CASE("a lost count of a counting encoder is found") {
    std::vector<double> all = angles(steady, counts(60));
    for (std::size_t i = 9000; i < kCount; ++i) {
        all[i] -= kTurn / 60.0;
    }
    // The count falls back once; without that it is a count that comes late.
    for (std::size_t i = 9000; all[i] < all[8999]; ++i) {
        all[i] = all[8999];
    }
    CHECK_THAT(signals::shaft_angle(all, kLeast).problem, Catch::Contains("falls behind"));
}

std::vector<double> pulse_train(const Motion& turns, double per_turn, double jump = 0.0,
                                std::size_t at = kCount) {
    std::vector<double> all;
    for (std::size_t i = 0; i < kCount; ++i) {
        const double angle = turns(static_cast<double>(i) / kRate_Hz) + (i >= at ? jump : 0.0);
        const double phase = angle * per_turn - std::floor(angle * per_turn);
        all.push_back(phase < 0.5 ? 5.0 : 0.0);
    }
    return all;
}

TEST_CASE("pulses of real gearboxes pass, and jumps and missing pulses are found") {
    const double least = 0.05;  // pulses
    for (const Motion& turns :
         {Motion(steady), Motion(fast), Motion(torsional), Motion(load_step)}) {
        for (const double per_turn : {1.0, 5.0, 20.0}) {
            INFO(per_turn);
            CHECK(signals::tachometer_pulses(pulse_train(turns, per_turn), least).problem == "");
        }
    }
    // A pulse wheel with one wide gap in each turn.
    std::vector<double> at;
    const auto tape = [](double t) {
        const double turn = std::floor(t), phase = t - turn;
        return (turn * 20.0 + phase * 19.7) / 20.0;
    };
    CHECK(signals::tachometer_pulses(pulse_train([&](double t) { return tape(5.0 * t); }, 20.0),
                                     least)
              .problem == "");
    for (const double jump : {0.3, 0.49}) {
        CHECK(signals::tachometer_pulses(pulse_train(fast, 1.0, jump, 9000), least).problem != "");
    }
    for (const double jump : {0.02, 0.13}) {
        CHECK(signals::tachometer_pulses(pulse_train(steady, 20.0, jump, 9000), least).problem !=
              "");
    }
    std::vector<double> missing = pulse_train(fast, 1.0);
    std::fill(missing.begin() + 9000, missing.begin() + 9205, 0.0);
    CHECK_THAT(signals::tachometer_pulses(missing, least).problem, Catch::Contains("missing"));
}

}  // namespace gearpod::test_shaft_motion
