// HDF5 identifiers that close themselves, and HDF5 errors as exceptions instead of printed error
// stacks.
#pragma once

#include <hdf5.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace gearpod::mc {

// Failure of an HDF5 call; `what` names the attempted operation.
class Hdf5Error : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

class Hdf5Handle {
  public:
    using Close = herr_t (*)(hid_t);

    // Takes the return value of an HDF5 call. Throws Hdf5Error if the call failed.
    Hdf5Handle(hid_t id, Close close, const std::string& attempted) : id_(id), close_(close) {
        if (id < 0) {
            throw Hdf5Error(attempted);
        }
    }
    Hdf5Handle(Hdf5Handle&& other) noexcept
        : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
    Hdf5Handle& operator=(Hdf5Handle&&) = delete;
    ~Hdf5Handle() {
        if (id_ >= 0) {
            close_(id_);
        }
    }

    hid_t get() const { return id_; }

    // Closes the identifier. Throws Hdf5Error if that fails.
    void close_now(const std::string& attempted) {
        if (close_(std::exchange(id_, -1)) < 0) {
            throw Hdf5Error(attempted);
        }
    }

  private:
    hid_t id_;
    Close close_;
};

// Throws Hdf5Error if the status of a call is a failure.
inline void check(herr_t status, const std::string& attempted) {
    if (status < 0) {
        throw Hdf5Error(attempted);
    }
}

// Groups, datasets and attributes of an HDF5 file, in the shapes that gearpod writes. Not
// thread-safe, because HDF5 is not. All functions throw Hdf5Error.

using Shape = std::vector<hsize_t>;

// Open a file for reading, and tell whether it is HDF5. Like the functions that create files, they
// end the printing of HDF5's error stacks for the process.
Hdf5Handle open_file(const std::string& path, const std::string& attempted);
bool is_hdf5(const std::string& path);

// Creates a file in memory in which links and attributes keep their order. Equal contents give
// equal bytes.
Hdf5Handle create_memory_file();
// Content of the file, as it would be on the disk.
std::vector<std::byte> file_bytes(const Hdf5Handle& file);

// Creates such a file on the disk. Its first `user_block` bytes (0, 512, 1024, ...) are zeros that
// HDF5 neither reads nor writes.
Hdf5Handle create_file(const std::string& path, hsize_t user_block = 0);
// Creates a dataset of doubles or 64-bit integers and returns the position of its values in the
// file, 0 for no values. The caller writes the values (little-endian, row-major) there after
// closing the file; HDF5 keeps no copy of them.
enum class ColumnKind { numbers, integers };
std::uint64_t create_column(hid_t parent, const std::string& name, const Shape& shape,
                            ColumnKind kind);

Hdf5Handle create_group(hid_t parent, const std::string& name);
void write_numbers(hid_t parent, const std::string& name, const Shape& shape,
                   const std::vector<double>& values);
void write_integers(hid_t parent, const std::string& name, const Shape& shape,
                    const std::vector<std::int64_t>& values);
// Write attributes of a group or dataset; `object` is "." for the parent itself.
void write_text(hid_t parent, const std::string& object, const std::string& name,
                const std::string& text);
void write_number(hid_t parent, const std::string& object, const std::string& name, double value);

// True if a group below `root` has a soft or external link, which may lead to another file.
bool has_soft_links(hid_t root);

Hdf5Handle open_group(hid_t parent, const std::string& name);
Hdf5Handle open_dataset(hid_t parent, const std::string& name);
// Shape of a dataset. One with more than `most_values` values counts as damaged.
Shape shape_of(const Hdf5Handle& dataset, const std::string& name,
               std::size_t most_values = std::numeric_limits<std::size_t>::max());
// Number of values of a shape; more than `most_values` count as damaged.
std::size_t count_of(const Shape& shape,
                     std::size_t most_values = std::numeric_limits<std::size_t>::max(),
                     const std::string& name = "");
// Names of the links in a group, or of the attributes of an object, in order of creation.
std::vector<std::string> link_names(hid_t group);
std::vector<std::string> attribute_names(hid_t object);
// Values and their shape. A dataset larger than `most_values` counts as damaged.
struct Numbers {
    Shape shape;
    std::vector<double> values;
};
Numbers read_numbers(hid_t parent, const std::string& name, std::size_t most_values);
std::vector<std::int64_t> read_integers(hid_t parent, const std::string& name,
                                        std::size_t most_values);
// Number of values of a one-dimensional dataset.
std::size_t row_count(hid_t parent, const std::string& name);
// Reads a range of rows. The dataset counts as damaged unless it has the given shape: rows, or rows
// x columns.
struct RowRange {
    std::size_t first, count;
};
template <class Value>  // double or std::int64_t
void read_rows(hid_t parent, const std::string& name, const Shape& shape, RowRange range,
               std::vector<Value>& values);
// True for an attribute as write_text() writes it; other programs add attributes of other types.
bool has_text(hid_t object, const std::string& name);
std::string read_text(hid_t parent, const std::string& object, const std::string& name);
double read_number(hid_t parent, const std::string& object, const std::string& name);

}  // namespace gearpod::mc
