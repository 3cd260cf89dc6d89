// Recordings as CSV files, and columns of HDF5 files.
#pragma once

#include "mc/files/hdf5_data.hpp"
#include "tests/mc/program_json.hpp"

namespace gearpod::test {

// The small study whose features numpy computed, too (tests/features/reference/README.md).
inline const std::string kReferenceFolder =
    std::string(GEARPOD_SOURCE_DIR) + "/tests/features/reference/";
inline const std::string kSmallStudy = kReferenceFolder + "small.toml";

using CsvColumns = std::vector<std::vector<double>>;

// Writes a table below a header and returns its path.
inline std::string write_csv(const std::string& path, const std::string& header,
                             const CsvColumns& columns, int digits = 17,
                             const char* separator = ",") {
    std::ofstream stream(path);
    stream.precision(digits);
    stream << header << "\n";
    for (std::size_t i = 0; i < columns[0].size(); ++i) {
        for (std::size_t c = 0; c < columns.size(); ++c) {
            stream << (c == 0 ? "" : separator) << columns[c][i];
        }
        stream << "\n";
    }
    return path;
}

// Datasets of a group of an HDF5 file.
inline CsvColumns read_columns(const std::string& path, const std::string& group,
                               const std::vector<std::string>& names) {
    const mc::Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, path);
    const mc::Hdf5Handle opened = mc::open_group(file.get(), group);
    return mapped(names, [&](const std::string& name) {
        return mc::read_numbers(opened.get(), name, 1000000).values;
    });
}

inline std::vector<double> times(std::vector<double> values, double factor) {
    for (double& value : values) {
        value *= factor;
    }
    return values;
}

}  // namespace gearpod::test
