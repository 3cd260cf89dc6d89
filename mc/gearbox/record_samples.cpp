#include "mc/gearbox/record_samples.hpp"

#include "signals/spectra/synchronous_average.hpp"

namespace gearpod::mc {

double sample_s(const Scene& scene, const InstanceInputs& inputs) {
    return dynamics::mesh_period_s(scene.inputs(inputs)) / scene.samples_per_mesh();
}

std::size_t turn_samples(const Scene& scene) {
    return static_cast<std::size_t>(scene.span().planet_teeth) *
           static_cast<std::size_t>(scene.samples_per_mesh());
}

std::span<const double> folded_part(const Scene& scene, const LaneSignals& record,
                                    std::span<const double> samples) {
    const int turns = record.turns > 0 ? record.turns : scene.span().ring_teeth;
    return samples.first(static_cast<std::size_t>(turns) * turn_samples(scene));
}

void fold_again(const Scene& scene, LaneSignals& record) {
    record.folded =
        signals::fold_of_squares(folded_part(scene, record, record.sensor), turn_samples(scene));
}

}  // namespace gearpod::mc
