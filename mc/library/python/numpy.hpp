// Conversions between the program's columns and numpy arrays.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <memory>
#include <string>
#include <vector>

#include "mc/files/signal_file.hpp"

namespace gearpod::python {

namespace py = pybind11;

using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;

// Array that owns the values; they are not copied.
inline Doubles array_of(std::vector<double> values, std::vector<py::ssize_t> shape) {
    auto owner = std::make_unique<std::vector<double>>(std::move(values));
    const double* data = owner->data();
    const py::capsule free(owner.release(), [](void* values_of_array) {
        delete static_cast<std::vector<double>*>(values_of_array);
    });
    return Doubles(std::move(shape), data, free);
}

inline Doubles array_of(std::vector<double> values) {
    const auto size = static_cast<py::ssize_t>(values.size());
    return array_of(std::move(values), {size});
}

inline std::vector<double> vector_of(const Doubles& array) {
    return {array.data(), array.data() + array.size()};
}

// [(name, unit, array)]; a column has one value per row of `shape`.
inline py::list list_of(std::vector<mc::SignalColumn> columns,
                        const std::vector<py::ssize_t>& shape) {
    py::list list;
    for (mc::SignalColumn& column : columns) {
        list.append(
            py::make_tuple(column.name, column.unit, array_of(std::move(column.values), shape)));
    }
    return list;
}

// Path of a recording, or [(name, unit, array)] of one in memory. `name` is for messages.
inline mc::SignalSource source_of(const py::object& signal, const std::string& name) {
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

}  // namespace gearpod::python
