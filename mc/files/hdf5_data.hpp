// Groups, datasets and attributes of an HDF5 file in the few shapes that gearpod writes. Not
// thread-safe, as HDF5 is not. All functions throw Hdf5Error.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "mc/files/hdf5_handle.hpp"

namespace gearpod::mc {

using Shape = std::vector<hsize_t>;

// A new file in memory; links and attributes keep their order. Bytes are the same for the same
// content.
Hdf5Handle create_memory_file();
// Its bytes, as a file on the disk would have them.
std::vector<std::byte> file_bytes(const Hdf5Handle& file);

// A new file on the disk of the same kind.
Hdf5Handle create_file(const std::string& path);
// A dataset of doubles or of 64-bit integers whose values, little-endian and row-major, the caller
// writes into the closed file from this byte on. HDF5 keeps no copy of them. 0 if it has none.
enum class ColumnKind { numbers, integers };
std::uint64_t create_column(hid_t parent, const std::string& name, const Shape& shape,
                            ColumnKind kind);

Hdf5Handle create_group(hid_t parent, const std::string& name);
void write_numbers(hid_t parent, const std::string& name, const Shape& shape,
                   const std::vector<double>& values);
void write_integers(hid_t parent, const std::string& name, const Shape& shape,
                    const std::vector<std::int64_t>& values);
// Attributes of a group or dataset; `object` is "." for the parent itself.
void write_text(hid_t parent, const std::string& object, const std::string& name,
                const std::string& text);
void write_number(hid_t parent, const std::string& object, const std::string& name, double value);

Hdf5Handle open_group(hid_t parent, const std::string& name);
// Names of the links in a group, and of the attributes of an object, in the order of creation.
std::vector<std::string> link_names(hid_t group);
std::vector<std::string> attribute_names(hid_t object);
// Values and their shape; a dataset larger than `most_values` is damaged.
struct Numbers {
    Shape shape;
    std::vector<double> values;
};
Numbers read_numbers(hid_t parent, const std::string& name, std::size_t most_values);
std::vector<std::int64_t> read_integers(hid_t parent, const std::string& name,
                                        std::size_t most_values);
// Values of a dataset of one dimension.
std::size_t row_count(hid_t parent, const std::string& name);
// Some rows of a dataset; it is damaged if it has not `shape`, which is rows or rows x columns.
struct RowRange {
    std::size_t first, count;
};
void read_rows(hid_t parent, const std::string& name, const Shape& shape, RowRange range,
               std::vector<double>& values);
void read_rows(hid_t parent, const std::string& name, const Shape& shape, RowRange range,
               std::vector<std::int64_t>& values);
std::string read_text(hid_t parent, const std::string& object, const std::string& name);
double read_number(hid_t parent, const std::string& object, const std::string& name);

}  // namespace gearpod::mc
