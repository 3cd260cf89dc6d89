// MAT files of signals, read by matio.
#include <fmt/format.h>
#include <matio.h>

#include <cstdint>

#include "mc/files/hdf5_handle.hpp"
#include "mc/files/signal_file.hpp"

namespace gearpod::mc {
namespace {

using Matrix = std::unique_ptr<matvar_t, void (*)(matvar_t*)>;

template <class Value>
std::vector<double> values_of(const matvar_t& matrix, std::size_t count) {
    const auto* first = static_cast<const Value*>(matrix.data);
    return {first, first + count};
}

// The classes of numbers, among matio's others.
struct NumberClass {
    matio_classes type;
    std::vector<double> (*values)(const matvar_t&, std::size_t);
};
constexpr NumberClass kNumberClasses[] = {
    {MAT_C_DOUBLE, values_of<double>},      {MAT_C_SINGLE, values_of<float>},
    {MAT_C_INT64, values_of<std::int64_t>}, {MAT_C_UINT64, values_of<std::uint64_t>},
    {MAT_C_INT32, values_of<std::int32_t>}, {MAT_C_UINT32, values_of<std::uint32_t>},
    {MAT_C_INT16, values_of<std::int16_t>}, {MAT_C_UINT16, values_of<std::uint16_t>},
    {MAT_C_INT8, values_of<std::int8_t>},   {MAT_C_UINT8, values_of<std::uint8_t>},
};

// Empty unless the matrix holds real numbers.
std::vector<double> numbers(const matvar_t& matrix, std::size_t count) {
    if (matrix.data == nullptr || matrix.isComplex != 0 ||
        matrix.nbytes != count * static_cast<std::size_t>(matrix.data_size)) {
        return {};
    }
    for (const NumberClass& known : kNumberClasses) {
        if (known.type == matrix.class_type) {
            return known.values(matrix, count);
        }
    }
    return {};
}

bool is_real_vector(const matvar_t& matrix) {
    return matrix.class_type >= MAT_C_DOUBLE && matrix.class_type <= MAT_C_UINT64 &&
           matrix.isComplex == 0 && matrix.rank == 2 &&
           (matrix.dims[0] == 1 || matrix.dims[1] == 1);
}

class SignalMat : public SignalFile {
  public:
    explicit SignalMat(const std::string& path)
        : path_(path), file_(Mat_Open(path.c_str(), MAT_ACC_RDONLY), Mat_Close) {
        if (!file_) {
            throw SignalError(path + ": is no MAT file, or damaged");
        }
        for (;;) {
            const Matrix matrix(Mat_VarReadNextInfo(file_.get()), Mat_VarFree);
            if (!matrix) {
                break;
            }
            if (matrix->name != nullptr && is_real_vector(*matrix)) {
                names_.emplace_back(matrix->name);
            }
        }
    }

    std::vector<std::string> names() const override { return names_; }

    std::vector<double> read(const std::string& name) override {
        const SilentHdf5 silent;
        Mat_Rewind(file_.get());
        const Matrix matrix(Mat_VarRead(file_.get(), name.c_str()), Mat_VarFree);
        std::vector<double> values;
        if (matrix && is_real_vector(*matrix)) {
            values = numbers(*matrix, matrix->dims[0] * matrix->dims[1]);
        }
        if (values.empty()) {
            throw SignalError(fmt::format("{}: {} cannot be read", path_, name));
        }
        return values;
    }

    std::optional<double> sampling_Hz() override {
        if (!has("sampling_Hz")) {
            return std::nullopt;
        }
        const std::vector<double> rate = read("sampling_Hz");
        if (rate.size() != 1) {
            throw SignalError(path_ + ": sampling_Hz must be one number");
        }
        return rate.front();
    }

  private:
    std::string path_;
    std::unique_ptr<mat_t, int (*)(mat_t*)> file_;
    std::vector<std::string> names_;
};

}  // namespace

std::unique_ptr<SignalFile> open_signal_mat(const std::string& path) {
    const SilentHdf5 silent;
    return std::make_unique<SignalMat>(path);
}

}  // namespace gearpod::mc
