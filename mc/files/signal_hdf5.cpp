// HDF5 files of signals, as simulate writes them or from elsewhere.
#include <fmt/format.h>

#include <filesystem>

#include "mc/files/hdf5_data.hpp"
#include "mc/files/signal_file.hpp"

namespace gearpod::mc {
namespace {

// Whether `name` is a dataset of numbers of one dimension.
bool is_column(hid_t group, const std::string& name) {
    H5O_info_t info{};
    if (H5Oget_info_by_name2(group, name.c_str(), &info, H5O_INFO_BASIC, H5P_DEFAULT) < 0 ||
        info.type != H5O_TYPE_DATASET) {
        return false;
    }
    const Hdf5Handle dataset(H5Dopen2(group, name.c_str(), H5P_DEFAULT), H5Dclose, name);
    const Hdf5Handle type(H5Dget_type(dataset.get()), H5Tclose, name);
    const Hdf5Handle space(H5Dget_space(dataset.get()), H5Sclose, name);
    const H5T_class_t kind = H5Tget_class(type.get());
    return (kind == H5T_FLOAT || kind == H5T_INTEGER) &&
           H5Sget_simple_extent_ndims(space.get()) == 1;
}

// By name: groups from elsewhere do not know the order of their creation.
std::vector<std::string> columns_of(hid_t group) {
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
        if (is_column(group, name)) {
            names.push_back(name);
        }
    }
    return names;
}

class SignalHdf5 : public SignalFile {
  public:
    explicit SignalHdf5(const std::string& path)
        : path_(path),
          most_(std::filesystem::file_size(path)),
          file_(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, path),
          group_(open_group(file_.get(),
                            H5Lexists(file_.get(), "signals", H5P_DEFAULT) > 0 ? "signals" : "/")),
          names_(columns_of(group_.get())) {}

    std::vector<std::string> names() const override { return names_; }

    std::vector<double> read(const std::string& name) override {
        const SilentHdf5 silent;
        try {
            // Compressed values may be many times the file's bytes.
            constexpr std::size_t kMostCompressed = 1000;
            return read_numbers(group_.get(), name, kMostCompressed * most_).values;
        } catch (const Hdf5Error&) {
            throw SignalError(fmt::format("{}: {} cannot be read", path_, name));
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
    std::string path_;
    std::size_t most_;
    Hdf5Handle file_, group_;
    std::vector<std::string> names_;
};

}  // namespace

std::unique_ptr<SignalFile> open_signal_hdf5(const std::string& path) {
    const SilentHdf5 silent;
    try {
        return std::make_unique<SignalHdf5>(path);
    } catch (const Hdf5Error&) {
        throw SignalError(path + ": is no HDF5 file, or damaged");
    }
}

}  // namespace gearpod::mc
