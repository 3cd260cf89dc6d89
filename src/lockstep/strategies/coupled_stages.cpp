#include "lockstep/strategies/coupled_stages.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "lockstep/tile/span_tile.hpp"
#include "lockstep/tile/step_integrator.hpp"

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
        for (std::size_t l = 0; l < W; ++l) {
            motion.turn[l] = end.turn_per_m * std::fma(ahead * mesh_period_s_[l], v[l], q[l]);
            motion.rate[l] = end.turn_per_m * std::fma(part, v[l] - previous[l], v[l]);
        }
        return motion;
    }

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
        return start_ + stage_.period * (mesh_ + span_.run_in_meshes + phase);
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

// Shaft at two tiles: its column at each, and its twist at the start, [lane].
template <int W>
class ShaftTorque {
  public:
    ShaftTorque(const CouplingShaft& shaft, const std::size_t (&column)[2],
                std::span<StageTile<W>* const> stages, double start)
        : shaft_(shaft), column_{column[0], column[1]} {
        const EndMotion<W> a = motion(0, stages, start), b = motion(1, stages, start);
        for (std::size_t l = 0; l < W; ++l) {
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
        for (std::size_t l = 0; l < W; ++l) {
            const double twist = a.turn[l] - b.turn[l] - twist_[l];
            torque[l] = sign * std::fma(shaft_.stiffness_N_m_rad[l], twist,
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
    while (!std::ranges::all_of(tiles, &StageTile<W>::finished)) {
        const auto behind = static_cast<std::size_t>(
            std::ranges::min_element(tiles, {}, &StageTile<W>::next) - tiles.begin());
        for (const ShaftTorque<W>& torque : torques) {
            torque.set(behind, tiles);
        }
        tiles[behind]->step();
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
