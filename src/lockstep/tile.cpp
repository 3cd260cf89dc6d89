#include "lockstep/tile.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <stdexcept>

#include "lockstep/driven_march.hpp"
#include "lockstep/fault_schedule.hpp"
#include "lockstep/mesh_march.hpp"
#include "lockstep/rigid_rotation.hpp"
#include "lockstep/sensor_filter.hpp"

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

// The rows of one lane in [first, last) of all rows.
template <int W>
void copy_lane(const machine::AlignedVector& from, machine::AlignedVector& to, int lane, int first,
               int last) {
    const auto end = static_cast<std::size_t>(last) * W;
    for (std::size_t i = static_cast<std::size_t>(first) * W + static_cast<std::size_t>(lane);
         i < end; i += W) {
        to[i] = from[i];
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
          whole_(in_parts(settings) ? std::vector<MeshPart>{} : mesh_parts(plan, 1)),
          parts_(in_parts(settings) ? settings.parts : std::span<const MeshPart>(whole_)),
          march_mesh_(make_mesh_march<W>(plan, inputs)),
          driven_(make_driven(plan, inputs, settings.excitation)),
          rotation_(plan.layout, inputs),
          state_(rest_state(plan, inputs)) {
        result_.status.assign(W, LaneStatus::ok);
    }

    TileResult run() {
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

    // What drives gearboxes unevenly drives them a mesh period at a time.
    static bool in_parts(const TileSettings& settings) {
        return !settings.parts.empty() && settings.excitation == nullptr;
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
    void march(int mesh, const std::vector<PairOverride>& overrides, MeshRecord& record) {
        if (driven_ != nullptr) {
            (*driven_)(mesh, overrides, state_, record);
        } else {
            (*march_mesh_)(overrides, state_, record);
        }
        result_.marched += 1.0;
        rotation_.remove(state_);
    }

    // A part of a mesh period that is like all others.
    void march_part(const MeshPart& part, const std::vector<PairOverride>& overrides,
                    MeshRecord& record) {
        if (driven_ != nullptr && settings_.excitation->repeats()) {
            march(0, overrides, record);  // the part is all of it
            return;
        }
        march_mesh_->march_part(part.plan, overrides, state_, record);
        result_.marched += static_cast<double>(part.last_step - part.first_step) /
                           static_cast<double>(plan_.grid.steps.size());
        rotation_.remove(state_);
    }

    MeshRecord new_record() const { return make_record(plan_, W, settings_.with_motion); }

    void copy_part_lane(const MeshPart& part, const MeshRecord& from, MeshRecord& to,
                        int lane) const {
        const auto copy = [&](const machine::AlignedVector& a, machine::AlignedVector& b) {
            const int rows = static_cast<int>(a.size()) / (W * plan_.grid.samples);
            copy_lane<W>(a, b, lane, part.first_sample * rows, part.last_sample * rows);
        };
        copy(from.acceleration, to.acceleration);
        copy(from.te, to.te);
        copy(from.motion, to.motion);
    }

    static void copy_state_lane(const TileState& from, TileState& to, int lane) {
        copy_lane<W>(from.q, to.q, lane);
        copy_lane<W>(from.v, to.v, lane);
        copy_lane<W>(from.filter, to.filter, lane);
    }

    // Of a part's recorded accelerations in one lane.
    double largest_acceleration(const MeshPart& part, const MeshRecord& record, int lane) const {
        double result = 0.0;
        const auto row = static_cast<std::size_t>(plan_.channels()) * W;
        for (std::size_t i =
                 static_cast<std::size_t>(part.first_sample) * row + static_cast<std::size_t>(lane);
             i < static_cast<std::size_t>(part.last_sample) * row; i += W) {
            const double value = record.acceleration[i];
            result = std::isfinite(value) ? std::max(result, std::abs(value)) : INFINITY;
        }
        return result;
    }

    // Distance of two states, relative to the motion; velocities are weighed at the sensor's band
    // edge, filtered accelerations against the largest recorded one.
    double distance(const TileState& a, const TileState& b, double recorded, int lane) const {
        const double scale = largest<W>(b.q, lane);
        // Where the sensor sees next to nothing, rounding must not count as motion.
        const double acceleration =
            std::max(recorded, 0.01 * scale * plan_.low_pass_rad_s * plan_.low_pass_rad_s);
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
        for (TileState& orbit : orbit_) {
            fill_lane<W>(orbit.q, lane, 0.0);
            fill_lane<W>(orbit.v, lane, 0.0);
            fill_lane<W>(orbit.filter, lane, 0.0);
        }
    }

    // Lanes that did not get back to their orbit in the mesh periods they had.
    void mark_unsettled(const std::array<bool, W>& settled) {
        for (std::size_t l = 0; l < W; ++l) {
            if (!settled[l]) {
                result_.status[l] = LaneStatus::unsettled;
            }
        }
    }

    // Marches until every lane's state repeats the one a mesh period before, and keeps that mesh
    // period, wherever it began.
    void settle() {
        const std::size_t parts = parts_.size();
        result_.records.push_back(new_record());
        orbit_.assign(parts, state_);
        recorded_.assign(parts, {});
        MeshRecord record = new_record();
        std::array<bool, W> settled{};
        const std::size_t most = static_cast<std::size_t>(settings_.max_meshes) * parts;
        for (std::size_t at = 0; at <= most; ++at) {
            const std::size_t p = at % parts;
            const bool waiting = compare_with_orbit(p, at >= parts, settled);
            if (!waiting || at == most) {
                break;
            }
            march_part(parts_[p], {}, record);
            for (int l = 0; l < W; ++l) {
                if (settled[static_cast<std::size_t>(l)]) {
                    continue;
                }
                copy_part_lane(parts_[p], record, result_.records[0], l);
                recorded_[p][static_cast<std::size_t>(l)] =
                    largest_acceleration(parts_[p], record, l);
                if (diverged(l)) {
                    retire(l);
                    settled[static_cast<std::size_t>(l)] = true;
                }
            }
        }
        // Teeth that separate may move without ever repeating; marched mesh by mesh they need not.
        const bool may_wander =
            settings_.march_meshes > 0 && plan_.mesh_law == dynamics::MeshLaw::separating;
        if (!may_wander) {
            mark_unsettled(settled);
        }
        state_ = orbit_[0];
    }

    // Before part `p`: lanes whose state is what it was a mesh period ago have settled; it becomes
    // the orbit of all that had not. Whether any is still to settle.
    bool compare_with_orbit(std::size_t p, bool period_before, std::array<bool, W>& settled) {
        bool waiting = false;
        for (int l = 0; l < W; ++l) {
            bool& done = settled[static_cast<std::size_t>(l)];
            if (done) {
                continue;
            }
            done =
                period_before && distance(state_, orbit_[p], recorded(l), l) <= settings_.tolerance;
            copy_state_lane(state_, orbit_[p], l);
            waiting = waiting || !done;
        }
        return waiting;
    }

    // Largest acceleration of a lane's orbit.
    double recorded(int lane) const {
        double result = 0.0;
        for (const auto& part : recorded_) {
            result = std::max(result, part[static_cast<std::size_t>(lane)]);
        }
        return result;
    }

    // One part of a mesh of the pattern: quiet lanes stay on their orbit, the others march.
    // `passages` counts its steps; `id` is the mesh's record, or 0.
    void march_pattern_part(std::size_t p, const std::vector<PairOverride>& passages,
                            bool continues, std::array<bool, W>& quiet,
                            const std::array<bool, W>& finished, int& id) {
        const MeshPart& part = parts_[p];
        const int steps = part.last_step - part.first_step;
        const bool passing = std::any_of(
            passages.begin(), passages.end(),
            [&](const PairOverride& o) { return o.first_step < steps && o.last_step > 0; });
        bool any = false;
        for (int l = 0; l < W; ++l) {
            auto& q = quiet[static_cast<std::size_t>(l)];
            q = q && (!passing || !faulty(l));
            const bool open = !finished[static_cast<std::size_t>(l)];
            any = any || (!q && open);
            if (q && open && id != 0) {  // a disturbance of the pass before may stand there
                copy_part_lane(part, result_.records[0],
                               result_.records[static_cast<std::size_t>(id)], l);
            }
        }
        if (!any) {
            return;
        }
        if (id == 0) {
            id = static_cast<int>(result_.records.size());
            result_.records.push_back(result_.records[0]);
        }
        for (int l = 0; l < W; ++l) {
            if (quiet[static_cast<std::size_t>(l)]) {
                copy_state_lane(orbit_[p], state_, l);
            }
        }
        march_part(part, passages, record_);
        const TileState& orbit = orbit_[(p + 1) % parts_.size()];
        for (int l = 0; l < W; ++l) {
            auto& q = quiet[static_cast<std::size_t>(l)];
            if (q || finished[static_cast<std::size_t>(l)]) {
                continue;
            }
            copy_part_lane(part, record_, result_.records[static_cast<std::size_t>(id)], l);
            if (diverged(l)) {
                retire(l);
                q = true;
            } else {
                q = !continues && distance(state_, orbit, recorded(l), l) <= settings_.tolerance;
            }
            if (q) {
                copy_state_lane(orbit, state_, l);
            }
        }
    }

    void march_pattern_mesh(int k, std::array<bool, W>& quiet,
                            const std::array<bool, W>& finished) {
        std::vector<PairOverride> passages = schedule_.overrides(k);
        for (std::size_t p = 0; p < parts_.size(); ++p) {
            const int steps = parts_[p].last_step - parts_[p].first_step;
            const bool continues =
                p + 1 == parts_.size()
                    ? schedule_.continues_after(k)
                    : std::any_of(passages.begin(), passages.end(), [&](const PairOverride& o) {
                          return o.first_step < steps && o.last_step > steps;
                      });
            march_pattern_part(p, passages, continues, quiet, finished,
                               result_.content[static_cast<std::size_t>(k)]);
            for (PairOverride& o : passages) {
                o.first_step -= steps;
                o.last_step -= steps;
            }
        }
    }

    // Marches the pattern from the healthy orbit; where a disturbance outlives the pattern, again
    // from its own end, until that repeats.
    void march_pattern() {
        const int length = faults_.pattern.length;
        result_.content.assign(static_cast<std::size_t>(length), 0);
        record_ = new_record();
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
                       distance(state_, before, recorded(l), l) <= settings_.tolerance;
                waiting = waiting || !done;
            }
            if (!waiting) {
                return;
            }
        }
        mark_unsettled(finished);
    }

    // Every mesh of the span for itself.
    void march_everything() {
        MeshRecord unseen = new_record();
        for (int k = -settings_.run_in_meshes; k < 0; ++k) {
            march(k, schedule_.all_overrides(k), unseen);
        }
        for (int k = 0; k < settings_.march_meshes; ++k) {
            result_.content.push_back(static_cast<int>(result_.records.size()));
            result_.records.push_back(new_record());
            march(k, schedule_.all_overrides(k), result_.records.back());
        }
        for (int l = 0; l < W; ++l) {
            if (result_.status[static_cast<std::size_t>(l)] == LaneStatus::ok && diverged(l)) {
                retire(l);
            }
        }
    }

    const MarchPlan& plan_;
    const FaultCurves& faults_;
    const FaultSchedule schedule_;
    const TileSettings& settings_;
    const std::vector<MeshPart> whole_;
    const std::span<const MeshPart> parts_;
    const std::unique_ptr<const MeshMarch<W>> march_mesh_;
    const std::unique_ptr<DrivenMarch<W>> driven_;  // null: nothing drives it unevenly
    const RigidRotation rotation_;
    TileState state_;
    std::vector<TileState> orbit_;                 // the healthy orbit where each part begins
    std::vector<std::array<double, W>> recorded_;  // largest acceleration in each of its parts
    MeshRecord record_;                            // what is being marched of the pattern
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
