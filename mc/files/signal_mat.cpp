// Reads MAT files of signals with matio.
#include <fmt/format.h>
#include <matio.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>

#include "mc/files/hdf5_handle.hpp"
#include "mc/files/signal_file.hpp"
#include "mc/input/printable.hpp"

namespace gearpod::mc {
namespace {

using Matrix = std::unique_ptr<matvar_t, void (*)(matvar_t*)>;

template <class Value>
std::vector<double> values_of(const matvar_t& matrix, std::size_t count) {
    const auto* first = static_cast<const Value*>(matrix.data);
    return {first, first + count};
}

// Numeric classes of matio.
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

// Values of the matrix as doubles; empty unless they are real numbers.
std::vector<double> matrix_numbers(const matvar_t& matrix, std::size_t count) {
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

// True if a MAT file of version 5 or 7 is truncated; matio would read the missing part as zeros.
// The file is a sequence of elements: type and length (4 bytes each), then the data. Source:
// MathWorks, "MAT-File Level 5 File Format".
bool is_cut(const std::string& path) {
    constexpr std::uint64_t kHeader = 128, kTag = 8;
    std::ifstream file(path, std::ios::binary | std::ios::ate);
    const auto size = static_cast<std::uint64_t>(std::max<std::streamoff>(0, file.tellg()));
    std::array<unsigned char, kHeader> header{};
    const auto read = [&](std::uint64_t at, unsigned char* to, std::streamsize count) {
        file.seekg(static_cast<std::streamoff>(at));
        return static_cast<bool>(file.read(reinterpret_cast<char*>(to), count));
    };
    if (size < kHeader || !read(0, header.data(), kHeader)) {
        return false;
    }
    const bool little = header[126] == 'I' && header[127] == 'M';
    const bool big = header[126] == 'M' && header[127] == 'I';
    if ((!little && !big) || header[little ? 125 : 124] != 1) {
        return false;  // another version
    }
    std::array<unsigned char, kTag> tag{};
    std::uint64_t at = kHeader;
    while (size - at >= kTag && read(at, tag.data(), kTag)) {
        std::uint64_t length = 0;
        for (std::size_t i = 0; i < 4; ++i) {
            length = 256 * length + tag[little ? 7 - i : 4 + i];
        }
        if (length > size - at - kTag) {
            return true;
        }
        at += kTag + length;
    }
    return false;
}

// True for a single struct, false for an array of structs.
bool is_struct(const matvar_t& matrix) {
    return matrix.class_type == MAT_C_STRUCT && matrix.rank == 2 && matrix.dims[0] == 1 &&
           matrix.dims[1] == 1;
}

class SignalMat : public SignalFile {
  public:
    explicit SignalMat(const std::string& path)
        : path_(path), file_(Mat_Open(path.c_str(), MAT_ACC_RDONLY), Mat_Close) {
        if (!file_) {
            throw SignalError(path + ": is not a MAT file, or is damaged");
        }
        if (is_cut(path)) {
            throw SignalError(path + ": is truncated");
        }
        for (;;) {
            const Matrix matrix(Mat_VarReadNextInfo(file_.get()), Mat_VarFree);
            if (!matrix) {
                break;
            }
            if (matrix->name != nullptr) {
                list(*matrix);
            }
        }
        if (names_.empty() && !objects_.empty()) {
            throw SignalError(fmt::format(
                "{}: {} is a table, timetable or object, which is not supported; in MATLAB, save "
                "its columns as a struct: s = table2struct(T, 'ToScalar', true); save('FILE', 's')",
                path, printable(objects_)));
        }
    }

    std::vector<std::string> names() const override { return names_; }

    std::vector<double> read(const std::string& name) override {
        const SilentHdf5 silent;
        Mat_Rewind(file_.get());
        // "s.sensor" is a variable and its field; variable names contain no dots.
        const std::size_t dot = name.find('.');
        const Matrix whole(Mat_VarRead(file_.get(), name.substr(0, dot).c_str()), Mat_VarFree);
        const matvar_t* matrix = whole.get();
        if (matrix != nullptr && dot != std::string::npos) {
            matrix = is_struct(*whole)
                         ? Mat_VarGetStructFieldByName(whole.get(), name.substr(dot + 1).c_str(), 0)
                         : nullptr;
        }
        std::vector<double> values;
        if (matrix != nullptr && is_real_vector(*matrix)) {
            values = matrix_numbers(*matrix, matrix->dims[0] * matrix->dims[1]);
        }
        if (values.empty()) {
            throw SignalError(fmt::format("{}: {} cannot be read", path_, name));
        }
        return values;
    }

    std::optional<double> sampling_Hz() override {
        const auto named = std::find_if(names_.begin(), names_.end(), [](const std::string& name) {
            return name == "sampling_Hz" || name.ends_with(".sampling_Hz");
        });
        if (named == names_.end()) {
            return std::nullopt;
        }
        const std::vector<double> rate = read(*named);
        if (rate.size() != 1) {
            throw SignalError(path_ + ": sampling_Hz must be one number");
        }
        return rate.front();
    }

  private:
    // Adds a vector, or the vectors among the fields of a struct.
    void list(matvar_t& matrix) {
        if (is_object(matrix)) {
            objects_ += (objects_.empty() ? "" : ", ") + std::string(matrix.name);
        } else if (is_real_vector(matrix)) {
            names_.emplace_back(matrix.name);
        } else if (is_struct(matrix)) {
            char* const* const fields = Mat_VarGetStructFieldnames(&matrix);
            const unsigned count = Mat_VarGetNumberOfFields(&matrix);
            for (unsigned f = 0; fields != nullptr && f < count; ++f) {
                const matvar_t* field = Mat_VarGetStructFieldByIndex(&matrix, f, 0);
                if (field != nullptr && fields[f] != nullptr && is_real_vector(*field)) {
                    names_.push_back(fmt::format("{}.{}", matrix.name, fields[f]));
                }
            }
        }
    }

    // True for classes that matio does not know, such as tables, and for MATLAB objects.
    static bool is_object(const matvar_t& matrix) {
        const matio_classes type = matrix.class_type;
        return type == MAT_C_EMPTY || type == MAT_C_OBJECT || type == MAT_C_OPAQUE;
    }

    std::string path_;
    std::unique_ptr<mat_t, int (*)(mat_t*)> file_;
    std::vector<std::string> names_;
    std::string objects_;  // variables that are tables or objects
};

}  // namespace

std::unique_ptr<SignalFile> open_signal_mat(const std::string& path) {
    const SilentHdf5 silent;
    return std::make_unique<SignalMat>(path);
}

}  // namespace gearpod::mc
