#include "lockstep/tile/tile.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <stdexcept>

#include "lockstep/integrators/sensor_filter.hpp"
#include "lockstep/plan/fault_schedule.hpp"
#include "lockstep/tile/driven_march.hpp"
#include "lockstep/tile/mesh_march.hpp"
#include "lockstep/tile/rigid_rotation.hpp"

namespace gearpod::lockstep {
namespace {

// A motion this large is no gearbox any more; it only grows from there.
constexpr double kDivergedMotion_m = 1.0;

template <int W>
void copy_lane(const machine::AlignedVector& from, machine::AlignedVector& to, int lane) {
    for (std::size_t i = static_cast<std::size_t>(lane); i < from.size(); i += W) {
        to[i] = from[i];
    }
}

template <int W>
void fill_lane(machine::AlignedVector& values, int lane, double value) {
    for (std::size_t i = static_cast<std::size_t>(lane); i < values.size(); i += W) {
        values[i] = value;
    }
}

template <int W>
double largest(const machine::AlignedVector& values, int lane) {
    double result = 0.0;
    for (std::size_t i = static_cast<std::size_t>(lane); i < values.size(); i += W) {
        result = std::isfinite(values[i]) ? std::max(result, std::abs(values[i])) : INFINITY;
    }
    return result;
}

template <int W>
double largest_difference(const machine::AlignedVector& a, const machine::AlignedVector& b,
                          int lane) {
    double result = 0.0;
    for (std::size_t i = static_cast<std::size_t>(lane); i < a.size(); i += W) {
        result = std::max(result, std::abs(a[i] - b[i]));
    }
    return result;
}

template <int W>
class TileMarch {
  public:
    TileMarch(const MarchPlan& plan, std::span<const dynamics::GearboxInputs> inputs,
              const FaultCurves& faults, const TileSettings& settings)
        : plan_(plan),
          faults_(faults),
          schedule_(plan, faults),
          settings_(settings),
          march_mesh_(make_mesh_march<W>(plan, inputs)),
          driven_(make_driven(plan, inputs, settings.excitation)),
          rotation_(plan.layout, inputs),
          state_(rest_state(plan, inputs)) {
        result_.status.assign(W, LaneStatus::ok);
    }

    TileResult run() {
        result_.content.assign(static_cast<std::size_t>(settings_.march_meshes), kUnchanged);
        if (settings_.healthy != nullptr) {
            march_changes();
            return std::move(result_);
        }
        settle();
        if (settings_.march_meshes > 0) {
            march_everything();
        } else {
            march_pattern();
        }
        return std::move(result_);
    }

  private:
    bool faulty(int lane) const {
        return faults_.faulty(lane) &&
               result_.status[static_cast<std::size_t>(lane)] == LaneStatus::ok;
    }

    static std::unique_ptr<DrivenMarch<W>> make_driven(
        const MarchPlan& plan, std::span<const dynamics::GearboxInputs> inputs,
        const Excitation* excitation) {
        if (excitation == nullptr) {
            return nullptr;
        }
        if constexpr (W <= 8) {
            return make_driven_march<W>(plan, *excitation, inputs);
        } else {
            throw std::invalid_argument("gearboxes that are driven unevenly march in doubles");
        }
    }

    // Mesh period `mesh` as it is driven.
    void march(int mesh, const MeshOverrides& overrides, MeshRecord& record) {
        if (driven_ != nullptr) {
            (*driven_)(mesh, overrides, state_, record);
        } else {
            (*march_mesh_)(overrides, state_, record);
        }
        after_mesh();
    }

    // A healthy mesh period that is like all others.
    void march_settling(MeshRecord& record) {
        if (driven_ != nullptr && settings_.excitation->repeats()) {
            (*driven_)(0, {}, state_, record);
        } else {
            (*march_mesh_)({}, state_, record);
        }
        after_mesh();
    }

    void after_mesh() {
        ++result_.marched;
        rotation_.remove(state_);
    }

    MeshRecord new_record() const { return make_record(plan_, W, settings_.with_motion); }

    void copy_record_lane(const MeshRecord& from, MeshRecord& to, int lane) const {
        copy_lane<W>(from.acceleration, to.acceleration, lane);
        copy_lane<W>(from.te, to.te, lane);
        copy_lane<W>(from.motion, to.motion, lane);
    }

    static void copy_state_lane(const TileState& from, TileState& to, int lane) {
        copy_lane<W>(from.q, to.q, lane);
        copy_lane<W>(from.v, to.v, lane);
        copy_lane<W>(from.filter, to.filter, lane);
    }

    // Distance of two states, relative to the motion; velocities are weighed at the sensor's band
    // edge, filtered accelerations against the largest recorded one.
    double distance(const TileState& a, const TileState& b, const MeshRecord& record,
                    int lane) const {
        const double scale = largest<W>(b.q, lane);
        // Where the sensor sees next to nothing, rounding must not count as motion.
        const double acceleration =
            std::max(largest<W>(record.acceleration, lane),
                     0.01 * scale * plan_.low_pass_rad_s * plan_.low_pass_rad_s);
        const double dq = largest_difference<W>(a.q, b.q, lane);
        const double dv = largest_difference<W>(a.v, b.v, lane) / plan_.low_pass_rad_s;
        double df = 0.0;
        for (std::size_t i = static_cast<std::size_t>(lane); i < a.filter.size();
             i += 2 * W) {  // the sections' outputs; their rates follow
            df = std::max(df, std::abs(a.filter[i] - b.filter[i]));
        }
        const double motion = scale > 0.0 ? std::max(dq, dv) / scale : 0.0;
        return std::max(motion, acceleration > 0.0 ? df / acceleration : 0.0);
    }

    bool diverged(int lane) const {
        return !(largest<W>(state_.q, lane) < kDivergedMotion_m) ||
               !std::isfinite(largest<W>(state_.v, lane)) ||
               !std::isfinite(largest<W>(state_.filter, lane));
    }

    // Takes a lane that diverged out of the march: its records say NaN, its state rests at zero.
    void retire(int lane) {
        result_.status[static_cast<std::size_t>(lane)] = LaneStatus::diverged;
        for (MeshRecord& record : result_.records) {
            fill_lane<W>(record.acceleration, lane, NAN);
            fill_lane<W>(record.te, lane, NAN);
            fill_lane<W>(record.motion, lane, NAN);
        }
        fill_lane<W>(orbit_.q, lane, 0.0);
        fill_lane<W>(orbit_.v, lane, 0.0);
        fill_lane<W>(orbit_.filter, lane, 0.0);
    }

    // Lanes that did not get back to their orbit in the mesh periods they had.
    void mark_unsettled(const std::array<bool, W>& settled) {
        for (std::size_t l = 0; l < W; ++l) {
            if (!settled[l]) {
                result_.status[l] = LaneStatus::unsettled;
            }
        }
    }

    // Marches until every lane's mesh period repeats the one before, and keeps that one.
    void settle() {
        result_.records.push_back(new_record());
        orbit_ = state_;
        MeshRecord record = new_record();
        std::array<bool, W> settled{};
        for (int mesh = 0; mesh < settings_.max_meshes; ++mesh) {
            const TileState before = state_;
            march_settling(record);
            bool waiting = false;
            for (int l = 0; l < W; ++l) {
                if (settled[static_cast<std::size_t>(l)]) {
                    continue;
                }
                copy_record_lane(record, result_.records[0], l);
                copy_state_lane(state_, orbit_, l);
                const bool lost = diverged(l);
                if (lost) {
                    retire(l);
                }
                const bool done =
                    lost || distance(state_, before, record, l) <= settings_.tolerance;
                settled[static_cast<std::size_t>(l)] = done;
                waiting = waiting || !done;
            }
            if (!waiting) {
                break;
            }
        }
        // Teeth that separate may move without ever repeating; marched mesh by mesh they need not.
        const bool may_wander = settings_.march_meshes > 0 && dynamics::separates(plan_.mesh_law);
        if (!may_wander) {
            mark_unsettled(settled);
        }
        state_ = orbit_;
    }

    // One mesh of the pattern: quiet lanes stay on their orbit, the others march.
    void march_pattern_mesh(int k, std::array<bool, W>& quiet,
                            const std::array<bool, W>& finished) {
        const std::vector<PairOverride> passages = schedule_.overrides(k);
        bool any = false;
        for (int l = 0; l < W; ++l) {
            auto& q = quiet[static_cast<std::size_t>(l)];
            q = q && (passages.empty() || !faulty(l));
            any = any || (!q && !finished[static_cast<std::size_t>(l)]);
        }
        if (!any) {
            return;
        }
        MeshRecord record = new_record();
        march(0, {passages, {}}, record);
        int& id = result_.content[static_cast<std::size_t>(k)];
        if (id == 0) {
            id = static_cast<int>(result_.records.size());
            result_.records.push_back(result_.records[0]);
        }
        for (int l = 0; l < W; ++l) {
            auto& q = quiet[static_cast<std::size_t>(l)];
            if (q) {
                copy_state_lane(orbit_, state_, l);
                continue;
            }
            if (finished[static_cast<std::size_t>(l)]) {
                continue;
            }
            copy_record_lane(record, result_.records[static_cast<std::size_t>(id)], l);
            if (diverged(l)) {
                retire(l);
                q = true;
            } else if (!schedule_.continues_after(k) &&
                       distance(state_, orbit_, result_.records[0], l) <= settings_.tolerance) {
                q = true;
            }
            if (q) {
                copy_state_lane(orbit_, state_, l);
            }
        }
    }

    // Marches the pattern from the healthy orbit; where a disturbance outlives the pattern, again
    // from its own end, until that repeats.
    void march_pattern() {
        const int length = faults_.pattern.length;
        result_.content.assign(static_cast<std::size_t>(length), 0);
        std::array<bool, W> quiet;
        std::array<bool, W> finished;
        for (int l = 0; l < W; ++l) {
            quiet[static_cast<std::size_t>(l)] = true;
            finished[static_cast<std::size_t>(l)] = !faulty(l);
        }
        const int passes = 1 + (settings_.max_meshes + length - 1) / length;
        for (int pass = 0; pass < passes; ++pass) {
            const TileState before = state_;
            for (int k = 0; k < length; ++k) {
                march_pattern_mesh(k, quiet, finished);
            }
            bool waiting = false;
            for (int l = 0; l < W; ++l) {
                auto& done = finished[static_cast<std::size_t>(l)];
                done = done || quiet[static_cast<std::size_t>(l)] ||
                       distance(state_, before, result_.records[0], l) <= settings_.tolerance;
                waiting = waiting || !done;
            }
            if (!waiting) {
                return;
            }
        }
        mark_unsettled(finished);
    }

    // Where mesh k of the span is recorded.
    MeshRecord& add_record(int k) {
        result_.content[static_cast<std::size_t>(k)] = static_cast<int>(result_.records.size());
        return result_.records.emplace_back(new_record());
    }

    // Every mesh of the span for itself.
    void march_everything() {
        MeshRecord unseen = new_record();
        const auto keep_state = [&] {
            if (settings_.keep_states) {
                result_.states.push_back(state_);
            }
        };
        for (int k = -settings_.run_in_meshes; k < settings_.march_meshes; ++k) {
            keep_state();
            march(k, schedule_.all_overrides(k), k < 0 ? unseen : add_record(k));
        }
        keep_state();
        for (int l = 0; l < W; ++l) {
            if (result_.status[static_cast<std::size_t>(l)] == LaneStatus::ok && diverged(l)) {
                retire(l);
            }
        }
    }

    // From the healthy march's states: what a fault's passages change, until it has decayed.
    void march_changes() {
        MeshRecord unseen = new_record();
        bool away = false;
        for (int k = -settings_.run_in_meshes; k < settings_.march_meshes; ++k) {
            const auto at = static_cast<std::size_t>(k + settings_.run_in_meshes);
            if (!away && !schedule_.passes(k)) {
                continue;
            }
            if (!away) {
                state_ = (*settings_.healthy)[at];
            }
            MeshRecord& record = k >= 0 ? add_record(k) : unseen;
            march(k, schedule_.all_overrides(k), record);
            away = schedule_.continues_after(k);
            for (int l = 0; l < W; ++l) {
                if (result_.status[static_cast<std::size_t>(l)] != LaneStatus::ok) {
                    continue;
                }
                if (diverged(l)) {
                    retire(l);
                } else if (distance(state_, (*settings_.healthy)[at + 1], record, l) >
                           settings_.tolerance) {
                    away = true;
                }
            }
        }
    }

    const MarchPlan& plan_;
    const FaultCurves& faults_;
    FaultSchedule schedule_;
    const TileSettings& settings_;
    const std::unique_ptr<const MeshMarch<W>> march_mesh_;
    const std::unique_ptr<DrivenMarch<W>> driven_;  // null: nothing drives it unevenly
    const RigidRotation rotation_;
    TileState state_;
    TileState orbit_;  // the healthy orbit at an integer phase
    TileResult result_;
};

}  // namespace

template <int W>
TileResult run_tile(const MarchPlan& plan, std::span<const dynamics::GearboxInputs> inputs,
                    const FaultCurves& faults, const TileSettings& settings) {
    assert(inputs.size() == W && std::all_of(faults.curve.begin(), faults.curve.end(),
                                             [](const auto& lanes) { return lanes.size() == W; }));
    check_tooth_errors(plan, faults.tooth_errors, settings.march_meshes);
    check_excitation(settings.excitation, settings.march_meshes);
    if (settings.healthy != nullptr &&
        (settings.excitation != nullptr ||
         settings.healthy->size() !=
             static_cast<std::size_t>(settings.run_in_meshes + settings.march_meshes + 1))) {
        throw std::invalid_argument(
            "changes are marched from the states of as many steadily driven meshes");
    }
    return TileMarch<W>(plan, inputs, faults, settings).run();
}

#define GEARPOD_RUN_TILE(W)                                                                     \
    template TileResult run_tile<W>(const MarchPlan&, std::span<const dynamics::GearboxInputs>, \
                                    const FaultCurves&, const TileSettings&);
GEARPOD_RUN_TILE(1)
GEARPOD_RUN_TILE(4)
GEARPOD_RUN_TILE(8)
GEARPOD_RUN_TILE(16)
#undef GEARPOD_RUN_TILE

}  // namespace gearpod::lockstep
