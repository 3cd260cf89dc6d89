// Module gearpod._library of the Python package (analysis/python/gearpod/library.py documents the
// functions): the commands' computations in process, with numpy arrays in and out. Python's lock is
// released while they compute.
#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <atomic>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "machine/team.hpp"
#include "mc/ensemble/gearbox/simulation.hpp"
#include "mc/ensemble/ranks.hpp"
#include "mc/files/input/problems.hpp"
#include "mc/files/json_text.hpp"
#include "mc/library/inspection_table.hpp"
#include "mc/library/open_study.hpp"
#include "mc/library/own_values.hpp"
#include "mc/library/run/run_options.hpp"
#include "mc/library/signal_features.hpp"
#include "mc/library/stiffness_modes.hpp"
#include "mc/results/provenance.hpp"

namespace gearpod::python {

namespace py = pybind11;

using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;

// Failure of a gearbox; the message names its row.
class GearboxFailed : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

namespace {

void append(std::vector<double>& all, const std::vector<double>& values) {
    all.insert(all.end(), values.begin(), values.end());
}

void append(mc::Simulation& all, const mc::Simulation& next) {
    for (std::size_t c = 0; c < all.columns.size(); ++c) {
        append(all.columns[c].values, next.columns[c].values);
    }
    for (std::size_t m = 0; m < all.contact_loss.size(); ++m) {
        append(all.contact_loss[m].values, next.contact_loss[m].values);
    }
    append(all.features, next.features);
}

// Simulates the gearboxes in these rows of the results. All columns and features have the values of
// the first row, then those of the second, and so on. `interrupted` is polled by the calling thread
// between gearboxes; if it returns true, the result is empty. Throws BadInput for rows that do not
// exist and GearboxFailed. The values do not depend on the number of threads.
mc::Simulation simulate_rows(mc::OpenStudy& study, const std::vector<long>& rows, long meshes,
                             const std::function<bool()>& interrupted) {
    const mc::OpenStudy::Plans& plans = study.plans();
    std::vector<mc::Simulation> each(rows.size());
    std::atomic<bool> stopped{false};
    const auto caller = std::this_thread::get_id();
    machine::for_each_index(rows.size(), mc::thread_count(plans.ensemble), [&](std::size_t i) {
        if (std::this_thread::get_id() == caller && interrupted()) {
            stopped = true;
        }
        if (stopped) {
            return;
        }
        try {
            each[i] = mc::simulate_row(plans.tile, plans.ensemble, rows[i], meshes);
        } catch (const mc::BadInput&) {
            stopped = true;
            throw;
        } catch (const std::exception& error) {
            stopped = true;
            throw GearboxFailed(fmt::format("row {}: {}", rows[i], mc::exception_text(error)));
        }
    });
    if (stopped || each.empty()) {
        return {};
    }
    mc::Simulation all = std::move(each.front());
    for (std::size_t i = 1; i < each.size(); ++i) {
        append(all, each[i]);
        each[i] = {};
    }
    return all;
}

// Array that owns the values; they are not copied.
Doubles array_of(std::vector<double> values, std::vector<py::ssize_t> shape) {
    auto owner = std::make_unique<std::vector<double>>(std::move(values));
    const double* data = owner->data();
    const py::capsule free(owner.release(), [](void* values_of_array) {
        delete static_cast<std::vector<double>*>(values_of_array);
    });
    return Doubles(std::move(shape), data, free);
}

Doubles array_of(std::vector<double> values) {
    const auto size = static_cast<py::ssize_t>(values.size());
    return array_of(std::move(values), {size});
}

std::vector<double> vector_of(const Doubles& array) {
    return {array.data(), array.data() + array.size()};
}

// [(name, unit, array)]; a column has one value per row of `shape`.
py::list list_of(std::vector<mc::SignalColumn> columns, const std::vector<py::ssize_t>& shape) {
    py::list list;
    for (mc::SignalColumn& column : columns) {
        list.append(
            py::make_tuple(column.name, column.unit, array_of(std::move(column.values), shape)));
    }
    return list;
}

// Path of a recording, or [(name, unit, array)] of one in memory. `name` is for messages.
mc::SignalSource source_of(const py::object& signal, const std::string& name) {
    if (signal.is_none()) {
        return {};
    }
    if (py::isinstance<py::str>(signal)) {
        return signal.cast<std::string>();
    }
    std::vector<mc::SignalColumn> columns;
    for (const py::handle item : signal) {
        const auto column = item.cast<py::tuple>();
        columns.push_back({column[0].cast<std::string>(), column[1].cast<std::string>(),
                           vector_of(column[2].cast<Doubles>())});
    }
    return {name, std::move(columns)};
}

// Result of a computation without Python's lock.
template <typename Compute>
auto unlocked(Compute compute) {
    const py::gil_scoped_release release;
    return compute();
}

std::unique_ptr<mc::OpenStudy> open_study(const std::string& name,
                                          const std::optional<std::string>& text,
                                          const std::vector<std::string>& overrides,
                                          bool with_lines) {
    auto study = std::make_unique<mc::OpenStudy>(name, text, overrides, with_lines);
    if (!study->notices().empty() &&
        PyErr_WarnEx(PyExc_UserWarning, study->notices().c_str(), 2) != 0) {
        throw py::error_already_set();
    }
    return study;
}

py::list stiffness(mc::OpenStudy& study, int points, bool transmission_error) {
    if (points < 1) {
        throw mc::BadInput("points: must be at least 1");
    }
    return list_of(unlocked([&] {
                       return transmission_error
                                  ? mc::transmission_error_columns(*study.plans().tile.gearbox,
                                                                   points)
                                  : mc::stiffness_columns(*study.plans().tile.gearbox, points);
                   }),
                   {points});
}

// Texts by heading and name.
py::dict describe(mc::OpenStudy& study) {
    py::dict all;
    for (const mc::DescriptionSection& section : unlocked([&] { return study.description(); })) {
        py::dict entries;
        for (const auto& [name, text] : section.entries) {
            entries[py::str(name)] = text;
        }
        all[py::str(section.heading)] = entries;
    }
    return all;
}

Doubles modes(const mc::OpenStudy& study) {
    return array_of(unlocked([&] { return mc::natural_frequencies_Hz(study.modes()); }));
}

bool keyboard_interrupt() {
    const py::gil_scoped_acquire acquire;
    return PyErr_CheckSignals() != 0;
}

// Signals have the shape of `rows` x samples, features that of `rows` x noise levels.
py::dict simulate(mc::OpenStudy& study, const std::vector<long>& rows, long meshes) {
    mc::Simulation all =
        unlocked([&] { return simulate_rows(study, rows, meshes, &keyboard_interrupt); });
    if (PyErr_Occurred() != nullptr) {
        throw py::error_already_set();
    }
    const auto count = static_cast<py::ssize_t>(rows.size());
    const auto levels = static_cast<py::ssize_t>(all.noise_levels.size());
    const auto samples =
        static_cast<py::ssize_t>(all.columns.empty() ? 0 : all.columns.front().values.size()) /
        std::max<py::ssize_t>(1, count);
    py::dict contact_loss;
    for (mc::RowColumn& mesh : all.contact_loss) {
        contact_loss[py::str(mesh.name)] = array_of(std::move(mesh.values));
    }
    const auto features = static_cast<py::ssize_t>(all.feature_names.size());
    py::dict result;
    result["signals"] = list_of(std::move(all.columns), {count, samples});
    result["noise_levels"] = array_of(std::move(all.noise_levels));
    result["feature_names"] = all.feature_names;
    result["features"] = array_of(std::move(all.features), {count, features, levels});
    result["contact_loss"] = contact_loss;
    return result;
}

mc::SpeedCheck speed_check(const std::string& speed) {
    if (speed != "check" && speed != "found" && speed != "stated") {
        throw mc::BadInput("speed: must be check, found or stated, but is " + speed);
    }
    return speed == "found"    ? mc::SpeedCheck::follow
           : speed == "stated" ? mc::SpeedCheck::ignore
                               : mc::SpeedCheck::refuse;
}

// JSON text of `features --json`.
std::string features(mc::OpenStudy& study, const py::object& signal, const py::object& baseline,
                     const py::list& healthy, const mc::SignalColumns& columns, double noise_level,
                     const std::string& against, const std::string& feature) {
    mc::SignalRequest request;
    request.signal = source_of(signal, "signal");
    request.columns = columns;
    request.baseline = source_of(baseline, "baseline");
    for (std::size_t i = 0; i < healthy.size(); ++i) {
        request.healthy.push_back(source_of(healthy[i], "healthy " + std::to_string(i + 1)));
    }
    request.noise_level = noise_level;
    request.against = against;
    request.feature = feature;
    return unlocked([&] {
        return mc::json_text(
            mc::signal_features_json(mc::signal_features(request, study.plans().tile), request));
    });
}

mc::TextTable table_of(const std::vector<std::string>& names,
                       const std::vector<std::vector<std::string>>& columns) {
    mc::TextTable table;
    table.path = "table";
    for (const std::string& name : names) {
        table.columns.push_back(mc::column_of(name));
    }
    const std::size_t rows = columns.empty() ? 0 : columns.front().size();
    for (std::size_t row = 0; row < rows; ++row) {
        table.lines.push_back(static_cast<long>(row + 1));
        table.rows.emplace_back();
        for (const std::vector<std::string>& column : columns) {
            if (column.size() != rows) {
                throw mc::BadInput("table: its columns differ in length");
            }
            table.rows.back().push_back(column[row]);
        }
    }
    return table;
}

py::tuple pod(const std::optional<std::string>& path, const std::vector<std::string>& names,
              const std::vector<std::vector<std::string>>& columns,
              const mc::InspectionOptions& options) {
    const auto [text, json] = unlocked([&] {
        const mc::InspectedTable inspected = mc::inspect_table(
            path ? mc::read_text_table(*path) : table_of(names, columns), options);
        return std::pair(mc::inspection_text(inspected),
                         mc::json_text(mc::inspection_json(inspected)));
    });
    return py::make_tuple(text, json);
}

std::string grade(const std::string& path, const std::string& name, const std::string& unit,
                  const std::string& alarm, double noise_level, const Doubles& values) {
    if (alarm != "high" && alarm != "low") {
        throw mc::BadInput("alarm: must be high or low, but is " + alarm);
    }
    const mc::OwnValues given{name, unit,
                              alarm == "low" ? analysis::Alarm::low : analysis::Alarm::high,
                              noise_level, vector_of(values)};
    return unlocked([&] { return mc::json_text(mc::grade_values(path, given)); });
}

// Raises gearpod.Failed with the exit code that the program would have.
void raise_failed(int code, const std::string& message) {
    const py::object type = py::module_::import("gearpod.program").attr("Failed");
    const py::object error = type(code, message);
    PyErr_SetObject(type.ptr(), error.ptr());
}

void translate(std::exception_ptr thrown) {
    try {
        std::rethrow_exception(thrown);
    } catch (const GearboxFailed& error) {
        raise_failed(mc::kSomeFailed, error.what());
    } catch (const mc::BadInput& error) {
        raise_failed(mc::kBadInput, error.what());
    } catch (const std::runtime_error& error) {
        raise_failed(mc::kBadInput, mc::exception_text(error));
    }
}

void add_signal_columns(py::module_& module) {
    py::class_<mc::SignalColumns>(module, "SignalColumns")
        .def(py::init<>())
        .def_readwrite("sensor", &mc::SignalColumns::sensor)
        .def_readwrite("te", &mc::SignalColumns::te)
        .def_readwrite("sampling_Hz", &mc::SignalColumns::sampling_Hz)
        .def_readwrite("samples_per_mesh", &mc::SignalColumns::samples_per_mesh)
        .def_property(
            "sensor_unit",
            [](const mc::SignalColumns& columns) { return columns.sensor_unit.unit; },
            [](mc::SignalColumns& columns, const std::string& unit) {
                columns.sensor_unit.unit = unit;
            })
        .def_property(
            "sensor_sensitivity",
            [](const mc::SignalColumns& columns) { return columns.sensor_unit.sensitivity; },
            [](mc::SignalColumns& columns, const std::string& sensitivity) {
                columns.sensor_unit.sensitivity = sensitivity;
            })
        .def_readwrite("tachometer", &mc::SignalColumns::tachometer)
        .def_readwrite("pulses_per_turn", &mc::SignalColumns::pulses_per_turn)
        .def_readwrite("encoder", &mc::SignalColumns::encoder)
        .def_readwrite("row", &mc::SignalColumns::row)
        .def_property(
            "speed", [](const mc::SignalColumns&) { return py::none(); },
            [](mc::SignalColumns& columns, const std::string& speed) {
                columns.speed = speed_check(speed);
            });
}

void add_inspection_options(py::module_& module) {
    using Options = mc::InspectionOptions;
    py::class_<Options>(module, "InspectionOptions")
        .def(py::init<>())
        .def_readwrite("size", &Options::size)
        .def_readwrite("hit", &Options::hits)
        .def_readwrite("response", &Options::values)
        .def_readwrite("specimen", &Options::specimen)
        .def_readwrite("link", &Options::links)
        .def_readwrite("size_scale", &Options::size_scale)
        .def_readwrite("response_scale", &Options::response_scale)
        .def_readwrite("convention", &Options::convention)
        .def_readwrite("bounds", &Options::bounds)
        .def_readwrite("alarm", &Options::alarm)
        .def_readwrite("threshold", &Options::threshold)
        .def_readwrite("false_call_rate", &Options::false_call_rate)
        .def_readwrite("left", &Options::left)
        .def_readwrite("right", &Options::right)
        .def_readwrite("floor", &Options::floor)
        .def_readwrite("target", &Options::target)
        .def_readwrite("confidence", &Options::confidence)
        .def_readwrite("fit_ceiling", &Options::fit_ceiling)
        .def_readwrite("firth", &Options::firth);
}

void define_module(py::module_& module) {
    py::register_exception_translator(&translate);
    add_signal_columns(module);
    add_inspection_options(module);
    py::class_<mc::OpenStudy>(module, "OpenStudy")
        .def(py::init(&open_study), py::arg("name"), py::arg("text"), py::arg("overrides"),
             py::arg("with_lines"))
        .def("stiffness", &stiffness, py::arg("points"), py::arg("transmission_error"))
        .def("describe", &describe)
        .def("modes", &modes)
        .def("simulate", &simulate, py::arg("rows"), py::arg("meshes"))
        .def("features", &features, py::arg("signal"), py::arg("baseline"), py::arg("healthy"),
             py::arg("columns"), py::arg("noise_level"), py::arg("against"), py::arg("feature"));
    module.def("pod", &pod, py::arg("path"), py::arg("names"), py::arg("columns"),
               py::arg("options"));
    module.def("grade", &grade, py::arg("path"), py::arg("name"), py::arg("unit"), py::arg("alarm"),
               py::arg("noise_level"), py::arg("values"));
    module.attr("version") = mc::version_text();
}

}  // namespace
}  // namespace gearpod::python

PYBIND11_MODULE(_library, module) {
    gearpod::python::define_module(module);
}
