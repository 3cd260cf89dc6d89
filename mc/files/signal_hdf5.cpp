// Reads HDF5 files of signals, as `simulate` and other programs write them.
#include <fmt/format.h>

#include <filesystem>

#include "mc/files/hdf5_data.hpp"
#include "mc/files/signal_file.hpp"
#include "mc/input/printable.hpp"

namespace gearpod::mc {
namespace {

// True if the values of a member are in another file. The author of the file could choose any path
// for it.
bool is_external(hid_t group, const std::string& name) {
    H5L_info_t link{};
    check(H5Lget_info(group, name.c_str(), &link, H5P_DEFAULT), name);
    if (link.type != H5L_TYPE_HARD && link.type != H5L_TYPE_SOFT) {
        return true;
    }
    H5O_info_t info{};
    if (H5Oget_info_by_name2(group, name.c_str(), &info, H5O_INFO_BASIC, H5P_DEFAULT) < 0 ||
        info.type != H5O_TYPE_DATASET) {
        return false;
    }
    const Hdf5Handle dataset(H5Dopen2(group, name.c_str(), H5P_DEFAULT), H5Dclose, name);
    const Hdf5Handle made(H5Dget_create_plist(dataset.get()), H5Pclose, name);
    return H5Pget_external_count(made.get()) > 0 || H5Pget_layout(made.get()) == H5D_VIRTUAL;
}

// Number of dimensions of a numeric dataset; 0 if `name` is not one.
int dimensions_of(hid_t group, const std::string& name) {
    H5O_info_t info{};
    if (H5Oget_info_by_name2(group, name.c_str(), &info, H5O_INFO_BASIC, H5P_DEFAULT) < 0 ||
        info.type != H5O_TYPE_DATASET) {
        return 0;
    }
    const Hdf5Handle dataset(H5Dopen2(group, name.c_str(), H5P_DEFAULT), H5Dclose, name);
    const Hdf5Handle type(H5Dget_type(dataset.get()), H5Tclose, name);
    const Hdf5Handle space(H5Dget_space(dataset.get()), H5Sclose, name);
    const H5T_class_t kind = H5Tget_class(type.get());
    return kind == H5T_FLOAT || kind == H5T_INTEGER ? H5Sget_simple_extent_ndims(space.get()) : 0;
}

Shape shape_of(hid_t group, const std::string& name) {
    const Hdf5Handle dataset(H5Dopen2(group, name.c_str(), H5P_DEFAULT), H5Dclose, name);
    const Hdf5Handle space(H5Dget_space(dataset.get()), H5Sclose, name);
    Shape shape(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space.get())));
    H5Sget_simple_extent_dims(space.get(), shape.data(), nullptr);
    return shape;
}

void reject_external(const std::string& path, hid_t group, const std::string& name) {
    if (is_external(group, name)) {
        throw SignalError(
            fmt::format("{}: {} is stored in another file (by a link, or external or virtual "
                        "storage), which is not supported; copy it into this file, for example "
                        "with h5copy or h5py's group.copy",
                        path, printable(name)));
    }
}

// The group /signals if it exists, else the root.
Hdf5Handle signals_of(const std::string& path, hid_t file) {
    if (H5Lexists(file, "signals", H5P_DEFAULT) <= 0) {
        return open_group(file, "/");
    }
    reject_external(path, file, "signals");
    return open_group(file, "signals");
}

// Names in alphabetical order, because groups of other programs do not record the order of
// creation.
std::vector<std::string> columns_of(const std::string& path, hid_t group, int dimensions) {
    H5G_info_t info{};
    check(H5Gget_info(group, &info), "names");
    std::vector<std::string> names;
    for (hsize_t i = 0; i < info.nlinks; ++i) {
        const ssize_t length =
            H5Lget_name_by_idx(group, ".", H5_INDEX_NAME, H5_ITER_INC, i, nullptr, 0, H5P_DEFAULT);
        check(length < 0 ? -1 : 0, "names");
        std::string name(static_cast<std::size_t>(length) + 1, '\0');
        H5Lget_name_by_idx(group, ".", H5_INDEX_NAME, H5_ITER_INC, i, name.data(), name.size(),
                           H5P_DEFAULT);
        name.pop_back();
        reject_external(path, group, name);
        if (dimensions_of(group, name) == dimensions) {
            names.push_back(name);
        }
    }
    return names;
}

class SignalHdf5 : public SignalFile {
  public:
    SignalHdf5(const std::string& path, std::optional<std::size_t> row)
        : path_(path),
          row_(row),
          most_(std::filesystem::file_size(path)),
          file_(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, path),
          group_(signals_of(path, file_.get())),
          names_(columns_of(path, group_.get(), row ? 2 : 1)) {}

    std::vector<std::string> names() const override { return names_; }

    std::vector<double> read(const std::string& name) override {
        const SilentHdf5 silent;
        try {
            // Compressed values may be much larger than the file.
            constexpr std::size_t kMostCompressed = 1000;
            std::vector<double> values =
                row_ ? row_of(name, kMostCompressed * most_)
                     : read_numbers(group_.get(), name, kMostCompressed * most_).values;
            if (H5Aexists_by_name(group_.get(), name.c_str(), "scale", H5P_DEFAULT) > 0) {
                const double scale = read_number(group_.get(), name, "scale");
                for (double& value : values) {
                    value *= scale;
                }
            }
            return values;
        } catch (const Hdf5Error&) {
            throw SignalError(fmt::format("{}: {} cannot be read", path_, name));
        }
    }

    std::string unit(const std::string& name) override {
        const SilentHdf5 silent;
        if (H5Aexists_by_name(group_.get(), name.c_str(), "unit", H5P_DEFAULT) <= 0) {
            return "";
        }
        try {
            return read_text(group_.get(), name, "unit");
        } catch (const Hdf5Error&) {
            throw SignalError(fmt::format("{}: the unit of {} must be text", path_, name));
        }
    }

    std::optional<double> sampling_Hz() override {
        const SilentHdf5 silent;
        for (const hid_t object : {group_.get(), file_.get()}) {
            if (H5Aexists_by_name(object, ".", "sampling_Hz", H5P_DEFAULT) > 0) {
                try {
                    return read_number(object, ".", "sampling_Hz");
                } catch (const Hdf5Error&) {
                    throw SignalError(path_ + ": the attribute sampling_Hz must be one number");
                }
            }
        }
        return std::nullopt;
    }

  private:
    std::vector<double> row_of(const std::string& name, std::size_t most) {
        const Shape shape = shape_of(group_.get(), name);
        if (shape[1] > most) {
            throw Hdf5Error(name);
        }
        if (*row_ >= shape[0]) {
            throw SignalError(
                fmt::format("{}: {} has {} rows, but row {} is requested (counted from 0)", path_,
                            name, shape[0], *row_));
        }
        std::vector<double> values;
        read_rows(group_.get(), name, shape, {*row_, 1}, values);
        return values;
    }

    std::string path_;
    std::optional<std::size_t> row_;
    std::size_t most_;
    Hdf5Handle file_, group_;
    std::vector<std::string> names_;
};

}  // namespace

std::unique_ptr<SignalFile> open_signal_hdf5(const std::string& path,
                                             std::optional<std::size_t> row) {
    const SilentHdf5 silent;
    try {
        return std::make_unique<SignalHdf5>(path, row);
    } catch (const Hdf5Error&) {
        throw SignalError(path + ": is not an HDF5 file, or is damaged");
    }
}

}  // namespace gearpod::mc
