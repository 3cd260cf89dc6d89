#include "lockstep/strategies/coupled_stages.hpp"

#include <algorithm>
#include <memory>

#include "lockstep/tile/integrated_tile.hpp"
#include "lockstep/tile/tile_integrators.hpp"

namespace gearpod::lockstep {
namespace {

// Rotation of a shaft's end, rad, and its rate, rad/s.
template <int W>
struct EndMotion {
    alignas(64) double turn[W], rate[W];
};

template <int W>
class StageTile : SpanTile<W> {
  public:
    // `start`: time at which the run-in begins, mesh periods of the first stage.
    StageTile(const CoupledStage& stage, const std::vector<ShaftEnd>& shafts,
              const Convergence& convergence, double start)
        : SpanTile<W>(stage.tile, convergence, stage.span, stage.tooth_errors, nullptr),
          stage_(stage),
          step_integrator_(make_step_integrator<W>(plan_, shafts, stage.tile.gearboxes)),
          shafts_(shafts),
          previous_m_s_(shafts.size() * W),
          mesh_period_s_(dynamics::mesh_periods_s(stage.tile.gearboxes)),
          start_(start),
          mesh_(-stage.span.run_in_meshes) {}

    // Starts on the periodic orbit.
    void start() {
        SpanTile<W>::start();
        scratch_ = this->new_record(streamed() && this->with_motion());
        begin_mesh();
    }

    bool finished() const { return mesh_ >= span_.meshes; }

    // Time of the middle of the next step, mesh periods of the first stage.
    double next() const { return time_at(next_step().phase + 0.5 * next_step().length); }

    // Motion of the end of a shaft at a time near the next step. Positions are extrapolated with
    // their velocity, velocities with their change in the previous step.
    EndMotion<W> motion(std::size_t shaft, double time) const {
        EndMotion<W> motion;
        const ShaftEnd& end = shafts_[shaft];
        const double ahead = (time - time_at(position_phase())) / stage_.period;
        const double part = previous_length_ > 0.0 ? (time - time_at(next_step().phase)) /
                                                         stage_.period / previous_length_
                                                   : 0.0;
        const double* q = this->state_.q.data() + end.degree * W;
        const double* v = this->state_.v.data() + end.degree * W;
        const double* previous = previous_m_s_.data() + shaft * W;
        for (LaneId l{0}; l < W; ++l) {
            motion.turn[l] = end.turn_per_m * (q[l] + ahead * mesh_period_s_[l] * v[l]);
            motion.rate[l] = end.turn_per_m * (v[l] + part * (v[l] - previous[l]));
        }
        return motion;
    }

    // Common rotation of all stages. A stage's part in it is `part` times its own free rotation.
    double inertia_kg(LaneId lane) const { return this->rotation_.inertia_kg(lane); }
    double rotation_m(LaneId lane) const { return this->rotation_.amount(this->state_.q, lane); }
    double rotation_m_s(LaneId lane) const { return this->rotation_.amount(this->state_.v, lane); }
    // Rotation of a shaft's end per unit of the free rotation, rad/m.
    double turn_of(std::size_t shaft) const {
        return shafts_[shaft].turn_per_m * this->rotation_.at(shafts_[shaft].degree);
    }
    // Subtracts rotation of a lane: `position_m` at the time of `first`, and `speed_m_s`.
    void subtract_rotation(double position_m, double speed_m_s, LaneId lane,
                           const StageTile& first) {
        const double later = (time_at(position_phase()) - first.time_at(first.position_phase())) *
                             first.mesh_period_s_[lane];
        this->rotation_.subtract(position_m + later * speed_m_s, lane, this->state_.q);
        this->rotation_.subtract(speed_m_s, lane, this->state_.v);
        for (std::size_t shaft = 0; shaft < shafts_.size(); ++shaft) {
            previous_m_s_[shaft * W + lane] -=
                speed_m_s * this->rotation_.at(shafts_[shaft].degree);
        }
    }

    bool begins_mesh() const { return step_ == 0; }

    // Torques of the next step, [shaft][lane].
    machine::AlignedVector& torques() { return step_integrator_->torques(); }

    void step() {
        for (std::size_t shaft = 0; shaft < shafts_.size(); ++shaft) {
            std::copy_n(this->state_.v.data() + shafts_[shaft].degree * W, W,
                        previous_m_s_.data() + shaft * W);
        }
        previous_length_ = next_step().length;
        (*step_integrator_)(step_, overrides_, this->state_, *record_);
        if (++step_ == static_cast<int>(plan_.grid.steps.size())) {
            end_mesh();
            ++mesh_;
            begin_mesh();
        }
    }

    TileResult take_result() {
        this->mark_diverged_lanes();
        this->add_contact_loss_of_span();
        return std::move(this->result_);
    }

  private:
    bool streamed() const { return span_.on_record != nullptr; }
    bool is_recorded() const { return mesh_ >= 0 && mesh_ < span_.meshes; }
    // False after the span, while other stages are still recorded.
    bool counts_contact() const { return !finished() && this->counts_contact_in(mesh_); }
    const Step& next_step() const { return plan_.grid.steps[static_cast<std::size_t>(step_)]; }

    double time_at(double phase) const {
        return start_ + stage_.period * (mesh_ + span_.run_in_meshes - stage_.lead + phase);
    }

    // Phase of the positions; velocities are those at the start of the next step.
    double position_phase() const {
        const bool parted = step_ == 0 || next_step().sample >= 0;
        return next_step().phase + (parted ? 0.0 : 0.5 * next_step().length);
    }

    void begin_mesh() {
        step_ = 0;
        overrides_ = this->schedule_.all_overrides(mesh_ + stage_.first_mesh);
        record_ = is_recorded() && !streamed() ? &this->add_record(mesh_) : &scratch_;
        if (counts_contact()) {
            record_->step_states.swap(contact_states_);
            size_step_states(plan_, W, *record_);
        }
        lends_ = this->lend_step_states(*record_);
    }

    void end_mesh() {
        this->finish_mesh(overrides_, lends_, *record_);
        if (shafts_.empty()) {
            this->rotation_.remove(this->state_);
        }
        if (counts_contact()) {
            LaneMask<W> all;
            all.fill(true);
            this->contact_->add_separation_time(*record_, overrides_, all, this->separation_time_);
            record_->step_states.swap(contact_states_);
        }
        if (is_recorded() && streamed()) {
            span_.on_record(mesh_, *record_);
        }
    }

    using SpanTile<W>::plan_, SpanTile<W>::span_;

    const CoupledStage& stage_;
    const std::unique_ptr<StepIntegrator<W>> step_integrator_;
    const std::vector<ShaftEnd>& shafts_;
    machine::AlignedVector previous_m_s_;      // [shaft][lane]: velocity before the previous step
    double previous_length_ = 0.0;             // of that step, mesh periods
    const std::vector<double> mesh_period_s_;  // [lane]
    const double start_;
    int mesh_, step_ = 0;  // of the next step
    MeshOverrides overrides_;
    MeshRecord scratch_;
    MeshRecord* record_ = nullptr;  // of the current mesh period
    machine::AlignedVector contact_states_;
    bool lends_ = false;
};

// Free rotation of all stages together, which no spring holds. Like that of one gearbox
// (RigidRotation) it is removed after every mesh period of the first stage.
template <int W>
class CommonRotation {
  public:
    // `columns`: two per shaft. Stages that no shaft connects with the first one have no part.
    CommonRotation(std::span<const CouplingShaft> shafts, std::span<const std::size_t> columns,
                   std::span<StageTile<W>* const> stages)
        : part_(stages.size(), 0.0) {
        part_[0] = 1.0;
        for (std::size_t pass = 0; pass < shafts.size(); ++pass) {
            for (std::size_t i = 0; i < shafts.size(); ++i) {
                const auto& [a, b] = shafts[i].stage;
                const double turn_a = stages[a]->turn_of(columns[2 * i]);
                const double turn_b = stages[b]->turn_of(columns[2 * i + 1]);
                if (part_[b] == 0.0) {
                    part_[b] = part_[a] * turn_a / turn_b;
                } else if (part_[a] == 0.0) {
                    part_[a] = part_[b] * turn_b / turn_a;
                }
            }
        }
    }

    void remove(std::span<StageTile<W>* const> stages) const {
        for (LaneId l{0}; l < W; ++l) {
            double inertia = 0.0, position = 0.0, speed = 0.0;
            for (std::size_t s = 0; s < stages.size(); ++s) {
                const double weight = part_[s] * stages[s]->inertia_kg(l);
                inertia += part_[s] * weight;
                position += weight * stages[s]->rotation_m(l);
                speed += weight * stages[s]->rotation_m_s(l);
            }
            for (std::size_t s = 0; s < stages.size(); ++s) {
                stages[s]->subtract_rotation(part_[s] * position / inertia,
                                             part_[s] * speed / inertia, l, *stages[0]);
            }
        }
    }

  private:
    std::vector<double> part_;
};

// Shaft at two tiles: its column at each, and its twist at the start, [lane].
template <int W>
class ShaftTorque {
  public:
    ShaftTorque(const CouplingShaft& shaft, const std::size_t (&column)[2],
                std::span<StageTile<W>* const> stages, double start)
        : shaft_(shaft), column_{column[0], column[1]} {
        const EndMotion<W> a = motion(0, stages, start), b = motion(1, stages, start);
        for (LaneId l{0}; l < W; ++l) {
            twist_[l] = a.turn[l] - b.turn[l];
        }
    }

    // Sets the torque for the next step of a stage, if the shaft ends there.
    void set(std::size_t stage, std::span<StageTile<W>* const> stages) const {
        if (shaft_.stage[0] != stage && shaft_.stage[1] != stage) {
            return;
        }
        const std::size_t side = shaft_.stage[0] == stage ? 0 : 1;
        const double time = stages[stage]->next(), sign = side == 0 ? -1.0 : 1.0;
        const EndMotion<W> a = motion(0, stages, time), b = motion(1, stages, time);
        double* torque = stages[stage]->torques().data() + column_[side] * W;
        for (LaneId l{0}; l < W; ++l) {
            const double twist = a.turn[l] - b.turn[l] - twist_[l];
            torque[l] = sign * (shaft_.stiffness_N_m_rad[l] * twist +
                                shaft_.damping_N_m_s_rad[l] * (a.rate[l] - b.rate[l]));
        }
    }

  private:
    EndMotion<W> motion(std::size_t side, std::span<StageTile<W>* const> stages,
                        double time) const {
        return stages[shaft_.stage[side]]->motion(column_[side], time);
    }

    const CouplingShaft& shaft_;
    const std::size_t column_[2];
    double twist_[W] = {};
};

}  // namespace

template <int W>
std::vector<TileResult> run_coupled_stages(std::span<const CoupledStage> stages,
                                           std::span<const CouplingShaft> shafts,
                                           const Convergence& convergence) {
    const double start = -stages.front().span.run_in_meshes;
    std::vector<std::vector<ShaftEnd>> ends(stages.size());
    std::vector<std::size_t> columns;  // two per shaft
    for (const CouplingShaft& shaft : shafts) {
        for (const std::size_t side : {0, 1}) {
            columns.push_back(ends[shaft.stage[side]].size());
            ends[shaft.stage[side]].push_back(shaft.end[side]);
        }
    }
    std::vector<std::unique_ptr<StageTile<W>>> owned;
    std::vector<StageTile<W>*> tiles;
    for (std::size_t s = 0; s < stages.size(); ++s) {
        owned.push_back(std::make_unique<StageTile<W>>(stages[s], ends[s], convergence, start));
        owned.back()->start();
        tiles.push_back(owned.back().get());
    }
    std::vector<ShaftTorque<W>> torques;
    for (std::size_t i = 0; i < shafts.size(); ++i) {
        const std::size_t column[] = {columns[2 * i], columns[2 * i + 1]};
        torques.emplace_back(shafts[i], column, tiles, start);
    }
    const CommonRotation<W> rotation(shafts, columns, tiles);
    while (!std::ranges::all_of(tiles, &StageTile<W>::finished)) {
        const auto earliest = static_cast<std::size_t>(
            std::ranges::min_element(tiles, {}, &StageTile<W>::next) - tiles.begin());
        for (const ShaftTorque<W>& torque : torques) {
            torque.set(earliest, tiles);
        }
        tiles[earliest]->step();
        if (earliest == 0 && tiles[0]->begins_mesh() && !shafts.empty()) {
            rotation.remove(tiles);
        }
    }
    std::vector<TileResult> results;
    std::ranges::transform(owned, std::back_inserter(results),
                           [](const auto& tile) { return tile->take_result(); });
    return results;
}

#define GEARPOD_COUPLED_STAGES(W, REAL)                     \
    template std::vector<TileResult> run_coupled_stages<W>( \
        std::span<const CoupledStage>, std::span<const CouplingShaft>, const Convergence&);
GEARPOD_FOR_DOUBLE_WIDTHS(GEARPOD_COUPLED_STAGES)
#undef GEARPOD_COUPLED_STAGES

}  // namespace gearpod::lockstep
