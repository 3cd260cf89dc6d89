// Results files that are complete and wrong but have a valid checksum, as after deliberate editing.
#pragma once

#include <fcntl.h>
#include <unistd.h>

#include "mc/files/atomic_file.hpp"
#include "mc/files/hdf5_data.hpp"
#include "mc/results/file_checksum.hpp"
#include "tests/test.hpp"

namespace gearpod::test {

// Replaces the checksum of a file by the one of its bytes.
inline void update_checksum(const std::string& path) {
    const mc::Descriptor file(::open(path.c_str(), O_RDWR | O_CLOEXEC));
    if (!mc::write_checksum(file.get())) {
        throw std::runtime_error(path + ": its checksum cannot be written");
    }
}

// Changes a results file through HDF5 and updates its checksum.
inline void edit_results(const std::string& path, const std::function<void(hid_t root)>& edit) {
    {
        const mc::Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose,
                                  "opening the file");
        edit(file.get());
    }
    update_checksum(path);
}

inline void replace_numbers(hid_t root, const std::string& name, const mc::Shape& shape,
                            const std::vector<double>& values) {
    mc::check(H5Ldelete(root, name.c_str(), H5P_DEFAULT), name);
    mc::write_numbers(root, name, shape, values);
}

}  // namespace gearpod::test
