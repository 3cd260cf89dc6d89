#include "mc/results/layout.hpp"

#include <algorithm>
#include <functional>
#include <iterator>
#include <span>

namespace gearpod::mc {

const char* failure_text(Status status) {
    switch (status) {
        case Status::ok:
            return "worked";
        case Status::diverged:
            return "diverged without a known reason";
        case Status::not_converged:
            return "did not converge to a periodic steady state";
        case Status::supercritical:
            return "is unstable: above a critical speed of the carrier, the bearings do not hold "
                   "the rotating bodies";
        case Status::parametric:
            return "is unstable by parametric resonance: the varying mesh stiffness makes its "
                   "motion grow";
        case Status::step_too_long:
            return "is too stiff or too light for the study's time step: set "
                   "numerics.steps_per_mesh, or an implicit numerics.integrator";
        case Status::no_equilibrium:
            return "has no equilibrium: in some positions no tooth carries the load";
    }
    return "";
}

namespace {

void write_numerical(hid_t root, const NumericalError& error, const Results& frame) {
    const Hdf5Handle group = create_group(root, "numerical");
    write_text(group.get(), ".", "setting", error.setting);
    write_text(group.get(), ".", "finer", error.finer);
    write_number(group.get(), ".", "gearboxes", error.gearboxes);
    if (!error.corrections.empty()) {
        write_number(group.get(), ".", "healthy_pairs", error.healthy_pairs);
        write_number(group.get(), ".", "faulty_pairs", error.faulty_pairs);
    }
    const std::size_t levels = frame.noise_levels.size();
    for (std::size_t f = 0; f < frame.features.size(); ++f) {
        const Hdf5Handle feature = create_group(group.get(), frame.features[f].name);
        const auto write = [&](const char* name, const auto& all, auto member) {
            std::vector<double> part;
            std::ranges::transform(std::span(all).subspan(f * levels, levels),
                                   std::back_inserter(part), member);
            write_numbers(feature.get(), name, {levels}, part);
        };
        write("rms", error.rms, std::identity());
        write("largest", error.largest, std::identity());
        if (!error.corrections.empty()) {
            for (const auto& number : kPairedCorrectionNumbers) {
                write(number.name, error.corrections, number.member);
            }
        }
        write_text(feature.get(), ".", "unit", frame.features[f].unit);
    }
}

NumericalError read_numerical(hid_t root, std::size_t most, const Results& results) {
    const Hdf5Handle group = open_group(root, "numerical");
    // Files of earlier versions have the attribute `rung`.
    const bool former = std::ranges::count(attribute_names(group.get()), "rung") > 0;
    NumericalError error{read_text(group.get(), ".", former ? "rung" : "setting"),
                         read_text(group.get(), ".", "finer"),
                         static_cast<int>(read_number(group.get(), ".", "gearboxes")),
                         {},
                         {}};
    const std::size_t levels = results.noise_levels.size();
    for (const FeatureResult& result : results.features) {
        const Hdf5Handle feature = open_group(group.get(), result.name);
        const auto read = [&](const char* name) {
            std::vector<double> values = read_numbers(feature.get(), name, most).values;
            if (values.size() != levels) {
                throw Hdf5Error(name);
            }
            return values;
        };
        std::ranges::copy(read("rms"), std::back_inserter(error.rms));
        std::ranges::copy(read("largest"), std::back_inserter(error.largest));
        if (std::ranges::count(link_names(feature.get()), kPairedCorrectionNumbers[0].name) > 0) {
            std::vector<PairedCorrection> own(levels);
            for (const auto& number : kPairedCorrectionNumbers) {
                const std::vector<double> values = read(number.name);
                for (std::size_t level = 0; level < levels; ++level) {
                    own[level].*number.member = values[level];
                }
            }
            std::ranges::copy(own, std::back_inserter(error.corrections));
        }
    }
    if (error.corrections.empty()) {
        return error;
    }
    if (error.corrections.size() != error.rms.size()) {
        throw Hdf5Error(kPairedCorrectionNumbers[0].name);
    }
    error.healthy_pairs = static_cast<int>(read_number(group.get(), ".", "healthy_pairs"));
    error.faulty_pairs = static_cast<int>(read_number(group.get(), ".", "faulty_pairs"));
    return error;
}

}  // namespace

void write_numerical_groups(hid_t root, const Results& frame) {
    if (frame.numerical) {
        write_numerical(root, *frame.numerical, frame);
    }
    if (frame.step_error) {
        const Hdf5Handle group = create_group(root, "step_error");
        for (const auto& number : kStepErrorNumbers) {
            write_number(group.get(), ".", number.name, (*frame.step_error).*number.member);
        }
        for (const auto& count : kStepErrorCounts) {
            write_number(group.get(), ".", count.name, (*frame.step_error).*count.member);
        }
    }
}

void read_numerical_groups(hid_t root, std::size_t most, Results& results) {
    const std::vector<std::string> groups = link_names(root);
    if (std::ranges::count(groups, "numerical") > 0) {
        results.numerical = read_numerical(root, most, results);
    }
    if (std::ranges::count(groups, "step_error") > 0) {
        const Hdf5Handle group = open_group(root, "step_error");
        StepError& error = results.step_error.emplace();
        for (const auto& number : kStepErrorNumbers) {
            error.*number.member = read_number(group.get(), ".", number.name);
        }
        for (const auto& count : kStepErrorCounts) {
            error.*count.member = static_cast<int>(read_number(group.get(), ".", count.name));
        }
    }
}

}  // namespace gearpod::mc
