#include "mc/results/layout.hpp"

#include <fmt/format.h>

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

constexpr const char* kAssumptions = "assumptions";
constexpr const char* kPairs = "pairs";

void write_rows(hid_t parent, const char* group_name, const AssumptionRows& again,
                const Results& frame) {
    const auto& [rows, changed] = again;
    if (changed.empty()) {
        return;
    }
    const Hdf5Handle group = create_group(parent, group_name);
    write_integers(group.get(), "rows", {rows.size()}, rows);
    for (const ChangedAssumption& assumption : changed) {
        const std::string name = fmt::format("{} x {:g}", assumption.key, assumption.factor);
        write_numbers(group.get(), name,
                      {rows.size(), frame.features.size(), frame.noise_levels.size()},
                      assumption.values);
        write_text(group.get(), name, "key", assumption.key);
        write_number(group.get(), name, "factor", assumption.factor);
    }
}

AssumptionRows read_rows(hid_t parent, const char* group_name, std::size_t most,
                         const Results& results) {
    AssumptionRows again;
    if (std::ranges::count(link_names(parent), group_name) == 0) {
        return again;
    }
    const Hdf5Handle group = open_group(parent, group_name);
    again.rows = read_integers(group.get(), "rows", most);
    const Shape shape{again.rows.size(), results.features.size(), results.noise_levels.size()};
    for (const std::string& name : link_names(group.get())) {
        if (name == "rows") {
            continue;
        }
        Numbers numbers = read_numbers(group.get(), name, most);
        if (numbers.shape != shape) {
            throw Hdf5Error(name);
        }
        again.changed.push_back({read_text(group.get(), name, "key"),
                                 read_number(group.get(), name, "factor"),
                                 std::move(numbers.values)});
    }
    return again;
}

void write_numerical(hid_t root, const NumericalError& error, const Results& frame) {
    const Hdf5Handle group = create_group(root, "numerical");
    write_text(group.get(), ".", "setting", error.setting);
    write_text(group.get(), ".", "finer", error.finer);
    write_number(group.get(), ".", "gearboxes", error.gearboxes);
    write_rows(group.get(), kPairs, error.pairs, frame);
    const std::size_t levels = frame.noise_levels.size();
    for (std::size_t f = 0; f < frame.features.size(); ++f) {
        const Hdf5Handle feature = create_group(group.get(), frame.features[f].name);
        const auto write = [&](std::string_view name, const auto& all, auto member) {
            std::vector<double> part;
            std::ranges::transform(std::span(all).subspan(f * levels, levels),
                                   std::back_inserter(part), member);
            write_numbers(feature.get(), std::string(name), {levels}, part);
        };
        write("rms", error.rms, std::identity());
        write("largest", error.largest, std::identity());
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
        const auto read = [&](std::string_view name) {
            std::vector<double> values =
                read_numbers(feature.get(), std::string(name), most).values;
            if (values.size() != levels) {
                throw Hdf5Error(std::string(name));
            }
            return values;
        };
        std::ranges::copy(read("rms"), std::back_inserter(error.rms));
        std::ranges::copy(read("largest"), std::back_inserter(error.largest));
    }
    error.pairs = read_rows(group.get(), kPairs, most, results);
    return error;
}

}  // namespace

void write_numerical_groups(hid_t root, const Results& frame) {
    if (frame.numerical) {
        write_numerical(root, *frame.numerical, frame);
    }
    if (frame.step_error) {
        const Hdf5Handle group = create_group(root, "step_error");
        for_each_field(*frame.step_error, [&](auto field, auto value) {
            write_number(group.get(), ".", std::string(field.name), value);
        });
    }
    write_rows(root, kAssumptions, frame.assumptions, frame);
}

void read_numerical_groups(hid_t root, std::size_t most, Results& results) {
    const std::vector<std::string> groups = link_names(root);
    if (std::ranges::count(groups, "numerical") > 0) {
        results.numerical = read_numerical(root, most, results);
    }
    if (std::ranges::count(groups, "step_error") > 0) {
        const Hdf5Handle group = open_group(root, "step_error");
        for_each_field(results.step_error.emplace(), [&](auto field, auto& value) {
            value = static_cast<std::remove_reference_t<decltype(value)>>(
                read_number(group.get(), ".", std::string(field.name)));
        });
    }
    results.assumptions = read_rows(root, kAssumptions, most, results);
}

}  // namespace gearpod::mc
