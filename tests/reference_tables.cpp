#include "tests/reference_tables.hpp"

#include "mc/files/hdf5_data.hpp"

namespace gearpod::test {
namespace {

constexpr std::size_t kMostValues = 1'000'000;

// Texts of a dataset of strings of fixed length.
std::vector<std::string> texts_of(const mc::Hdf5Handle& dataset, const mc::Hdf5Handle& type,
                                  std::size_t rows) {
    const std::size_t length = H5Tget_size(type.get());
    std::string characters(rows * length, '\0');
    mc::check(H5Dread(dataset.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, characters.data()),
              "texts");
    std::vector<std::string> texts;
    for (std::size_t row = 0; row < rows; ++row) {
        texts.emplace_back(characters.substr(row * length, length).c_str());
    }
    return texts;
}

}  // namespace

ReferenceTable reference_table(const std::string& path) {
    const std::string full = GEARPOD_TESTS_DIR "/" + path;
    const mc::Hdf5Handle file(H5Fopen(full.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, full);
    ReferenceTable table;
    for (const std::string& name : mc::link_names(file.get())) {
        const mc::Hdf5Handle dataset(H5Dopen2(file.get(), name.c_str(), H5P_DEFAULT), H5Dclose,
                                     name);
        const mc::Hdf5Handle type(H5Dget_type(dataset.get()), H5Tclose, name);
        if (H5Tget_class(type.get()) == H5T_STRING) {
            table.texts[name] = texts_of(dataset, type, mc::row_count(file.get(), name));
        } else {
            table.names.push_back(name);
            table.numbers[name] = mc::read_numbers(file.get(), name, kMostValues).values;
        }
    }
    return table;
}

}  // namespace gearpod::test
