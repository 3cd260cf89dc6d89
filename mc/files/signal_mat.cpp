// Reads MAT files of signals with matio.
#include <fmt/format.h>
#include <matio.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "mc/files/column_search.hpp"
#include "mc/files/formats/byte_numbers.hpp"
#include "mc/files/hdf5_data.hpp"
#include "mc/files/input/file_text.hpp"
#include "mc/files/input/terminal_text.hpp"
#include "mc/files/signal_file.hpp"

namespace gearpod::mc {

using MatHandle = std::unique_ptr<mat_t, int (*)(mat_t*)>;
using MatVariable = std::unique_ptr<matvar_t, void (*)(matvar_t*)>;

// Array in a MAT file: a variable, or within one, for example "s.sensor", "s(2).data" or "c{1}".
struct MatArray {
    std::string name;
    std::size_t variable = 0;  // index in the file, from 0
    matio_classes type = MAT_C_EMPTY;
    bool complex = false;
    std::vector<unsigned long long> shape;

    bool is_number() const { return type >= MAT_C_DOUBLE && type <= MAT_C_UINT64 && !complex; }
    bool is_object() const {  // true for classes that matio does not know, such as tables
        return type == MAT_C_EMPTY || type == MAT_C_OBJECT || type == MAT_C_OPAQUE;
    }
};

// Reason why a file that is named .mat cannot be read: it is truncated, or of another kind. matio
// would read missing parts as zeros. Empty if no reason is found.
std::string mat_file_problem(const std::string& path);

// Arrays of all variables, in the order of the file. A variable that occurs again replaces the
// earlier one, as in MATLAB; `repeated` gets the names.
std::vector<MatArray> mat_arrays(mat_t* file, std::vector<std::string>& repeated);

// Variable with this index, with its values. Empty if it cannot be read.
MatVariable read_mat_variable(mat_t* file, std::size_t index);

// The array of this name within a variable that was read, null if there is none.
const matvar_t* mat_array_in(matvar_t& variable, const std::string& name);

namespace {

constexpr std::size_t kDeepestStruct = 16, kMostArrays = 200000;

std::size_t elements_of(const matvar_t& matrix) {
    std::size_t count = 1;
    for (int d = 0; d < matrix.rank; ++d) {
        count *= matrix.dims[d];
    }
    return matrix.rank > 0 ? count : 0;
}

// Calls `take` with every array and its name until it returns true; returns true then.
using TakeArray = std::function<bool(const std::string&, matvar_t&)>;
bool each_array(matvar_t& matrix, const std::string& name, std::size_t depth,
                const TakeArray& take) {
    const std::size_t elements = elements_of(matrix);
    if (matrix.class_type == MAT_C_STRUCT && depth < kDeepestStruct) {
        char* const* const fields = Mat_VarGetStructFieldnames(&matrix);
        const unsigned count = Mat_VarGetNumberOfFields(&matrix);
        for (std::size_t e = 0; fields != nullptr && e < elements; ++e) {
            const std::string element = elements == 1 ? name : fmt::format("{}({})", name, e + 1);
            for (unsigned f = 0; f < count; ++f) {
                matvar_t* const field = Mat_VarGetStructFieldByIndex(&matrix, f, e);
                if (field != nullptr && fields[f] != nullptr &&
                    each_array(*field, element + "." + fields[f], depth + 1, take)) {
                    return true;
                }
            }
        }
        return false;
    }
    if (matrix.class_type == MAT_C_CELL && depth < kDeepestStruct) {
        for (std::size_t e = 0; matrix.data != nullptr && e < elements; ++e) {
            matvar_t* const cell = Mat_VarGetCell(&matrix, static_cast<int>(e));
            if (cell != nullptr &&
                each_array(*cell, fmt::format("{}{{{}}}", name, e + 1), depth + 1, take)) {
                return true;
            }
        }
        return false;
    }
    return take(name, matrix);
}

// True if a MAT file of version 5 or 7 is truncated; matio would read the missing part as zeros.
// The file is a sequence of elements: type and length (4 bytes each), then the data. Source:
// MathWorks, "MAT-File Level 5 File Format".
bool is_cut(const std::string& path) {
    constexpr std::uint64_t kHeader = 128, kTag = 8;
    std::ifstream file(path, std::ios::binary | std::ios::ate);
    const auto size = static_cast<std::uint64_t>(std::max<std::streamoff>(0, file.tellg()));
    std::array<char, kHeader> header{};
    const auto read = [&](std::uint64_t at, char* to, std::streamsize count) {
        file.seekg(static_cast<std::streamoff>(at));
        return static_cast<bool>(file.read(to, count));
    };
    if (size < kHeader || !read(0, header.data(), kHeader)) {
        return false;
    }
    const bool little = header[126] == 'I' && header[127] == 'M';
    const bool big = header[126] == 'M' && header[127] == 'I';
    if ((!little && !big) || header[little ? 125 : 124] != 1) {
        return false;  // another version
    }
    std::array<char, kTag> tag{};
    std::uint64_t at = kHeader;
    while (size - at >= kTag && read(at, tag.data(), kTag)) {
        const std::uint64_t length = unsigned_at({tag.data(), kTag}, 4, 4, big);
        if (length > size - at - kTag) {
            return true;
        }
        at += kTag + length;
    }
    return false;
}

// True if a file begins with zeros, as one does that was not written to its end.
bool begins_with_zeros(const std::string& path) {
    std::array<char, 64> head{'x'};
    std::ifstream(path, std::ios::binary).read(head.data(), head.size());
    return std::ranges::count(head, '\0') == 64;
}

}  // namespace

std::string mat_file_problem(const std::string& path) {
    return begins_with_zeros(path) ? "begins with zeros, as if it had not been written to its end"
           : is_cut(path)          ? "is truncated"
                                   : "";
}

std::vector<MatArray> mat_arrays(mat_t* file, std::vector<std::string>& repeated) {
    std::vector<MatArray> all;
    std::map<std::string, std::size_t> last;
    Mat_Rewind(file);
    for (std::size_t index = 0;; ++index) {
        const MatVariable variable(Mat_VarReadNextInfo(file), Mat_VarFree);
        if (!variable) {
            break;
        }
        if (variable->name == nullptr) {
            continue;
        }
        const std::string name = variable->name;
        if (const auto [earlier, is_new] = last.insert_or_assign(name, index); !is_new) {
            std::erase_if(all, [&](const MatArray& array) {
                return array.name == name || array.name.starts_with(name + ".") ||
                       array.name.starts_with(name + "(") || array.name.starts_with(name + "{");
            });
            if (std::ranges::find(repeated, name) == repeated.end()) {
                repeated.push_back(name);
            }
        }
        each_array(*variable, name, 0, [&](const std::string& path, matvar_t& matrix) {
            MatArray array{path, index, matrix.class_type, matrix.isComplex != 0, {}};
            for (int d = 0; d < matrix.rank; ++d) {
                array.shape.push_back(matrix.dims[d]);
            }
            all.push_back(std::move(array));
            return all.size() >= kMostArrays;
        });
    }
    return all;
}

MatVariable read_mat_variable(mat_t* file, std::size_t index) {
    Mat_Rewind(file);
    for (std::size_t i = 0;; ++i) {
        MatVariable variable(Mat_VarReadNextInfo(file), Mat_VarFree);
        if (!variable || i == index) {
            if (variable && Mat_VarReadDataAll(file, variable.get()) != 0) {
                variable.reset();
            }
            return variable;
        }
    }
}

const matvar_t* mat_array_in(matvar_t& variable, const std::string& name) {
    const matvar_t* found = nullptr;
    each_array(variable, variable.name, 0, [&](const std::string& path, matvar_t& matrix) {
        found = path == name ? &matrix : nullptr;
        return found != nullptr;
    });
    return found;
}

namespace {

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

// Text of a char array; "" if it is none.
std::string mat_text(const matvar_t& matrix) {
    std::string text;
    const std::size_t bytes = matrix.nbytes;
    if (matrix.class_type != MAT_C_CHAR || matrix.data == nullptr || bytes > 1000) {
        return "";
    }
    const auto* const data = static_cast<const unsigned char*>(matrix.data);
    const auto width = static_cast<std::size_t>(std::max(1, matrix.data_size));
    for (std::size_t at = 0; at + width <= bytes; at += width) {
        const unsigned code = width == 1 ? data[at] : data[at] | data[at + 1] << 8U;
        if (width == 1) {
            text += static_cast<char>(code);
        } else {
            append_utf8(text, code);
        }
    }
    return text;
}

class SignalMat : public NamedColumns {
  public:
    explicit SignalMat(const std::string& path)
        : NamedColumns(path, "name"), file_(Mat_Open(path.c_str(), MAT_ACC_RDONLY), Mat_Close) {
        const std::string problem = mat_file_problem(path);
        if (!file_ || !problem.empty()) {
            throw SignalError(fmt::format(
                "{}: {}", path, problem.empty() ? "is not a MAT file, or is damaged" : problem));
        }
        arrays_ = mat_arrays(file_.get(), repeated_);
        for (const MatArray& array : arrays_) {
            all_.push_back(array.name);
            if (is_vector(array)) {
                names_.push_back(array.name);
            }
        }
        const bool any = std::ranges::any_of(arrays_, &MatArray::is_number);
        const auto object = std::ranges::find_if(arrays_, &MatArray::is_object);
        if (!any && object != arrays_.end()) {
            throw SignalError(path + ": " + problem_of(*object));
        }
    }

    std::vector<std::string> names() const override { return names_; }

    std::string contents() override {
        std::vector<std::string> texts;
        for (const MatArray& array : arrays_) {
            texts.push_back(text_of(array));
        }
        return listed_text(texts);
    }

    std::string find(const ColumnChoice& choice) override {
        const std::string found = NamedColumns::find(choice);
        const std::string variable = found.substr(0, found.find_first_of(".({:"));
        if (!found.empty() && std::ranges::find(repeated_, variable) != repeated_.end()) {
            add_note("the variable " + variable +
                     " occurs more than once; the last one is used, as in MATLAB");
        }
        return found;
    }

    std::vector<double> read(const std::string& name) override {
        const SilentHdf5 silent;
        const auto part = matrix_column(name);
        const MatArray* const array = array_of(name);
        std::vector<double> values;
        if (array != nullptr) {
            const MatVariable whole = read_mat_variable(file_.get(), array->variable);
            const matvar_t* const matrix = whole ? mat_array_in(*whole, array->name) : nullptr;
            std::size_t count = 1;
            for (const auto size : array->shape) {
                count *= size;
            }
            values = matrix == nullptr ? values : matrix_numbers(*matrix, count);
        }
        if (values.empty()) {
            throw SignalError(fmt::format("{}: {} cannot be read", path_, printable(name)));
        }
        const auto form = signal_form(array->shape);
        return form && form->columns && part
                   ? column_of_matrix(values, *array, *form, part->column - 1)
                   : values;
    }

    // The text NAME_unit next to the column, or `unit` next to it if it is the only signal there.
    std::string unit(const std::string& name) override {
        const SilentHdf5 silent;
        const MatArray* const array = array_of(name);
        const std::string group = group_of(array->name, '.');
        std::string unit;
        for (const MatArray& other : arrays_) {
            if (other.type != MAT_C_CHAR || group_of(other.name, '.') != group) {
                continue;
            }
            const std::string plain = plain_name(leaf_of(other.name, '.'));
            const std::string own = plain_name(leaf_of(array->name, '.'));
            const bool of_column = plain == own + "unit" || plain == own + "units";
            if (!of_column && plain != "unit" && plain != "units") {
                continue;
            }
            const MatVariable whole = read_mat_variable(file_.get(), other.variable);
            const matvar_t* const matrix = whole ? mat_array_in(*whole, other.name) : nullptr;
            const std::string text = matrix == nullptr ? "" : mat_text(*matrix);
            if (of_column) {
                return text;
            }
            if (signals_in(group) == 1) {
                unit = text;
            } else if (!text.empty()) {
                add_note(
                    fmt::format("{} = {} is not used, because it may belong to several columns",
                                other.name, text));
            }
        }
        return unit;
    }

    std::optional<double> sampling_Hz() override {
        for (const MatArray& array : arrays_) {
            if (plain_name(leaf_of(array.name, '.')) == "samplinghz") {
                return sampling_Hz_of(array.name);
            }
        }
        return sampling_Hz_of("");
    }

    // The rate next to the column, or in the structs around it.
    std::optional<double> sampling_Hz_of(const std::string& column) override {
        for (std::string group = group_of(column, '.');; group = group_of(group, '.')) {
            std::vector<NumberStatement> all;
            for (const MatArray& array : arrays_) {
                const std::string leaf = leaf_of(array.name, '.');
                if (group_of(array.name, '.') != group || !stated_rate_Hz({leaf, 1.0}) ||
                    !array.is_number()) {
                    continue;
                }
                const std::vector<double> rate = read(array.name);
                if (rate.size() == 1) {
                    all.push_back({leaf, rate.front()});
                } else if (leaf == "sampling_Hz") {
                    throw SignalError(path_ + ": sampling_Hz must be one number");
                }
            }
            if (!all.empty() || group.empty()) {
                return agreed_rate_Hz(all, path_);
            }
        }
    }

  private:
    std::vector<std::string> matching(const ColumnChoice& choice) const override {
        return matching_columns(all_, choice, '.');
    }
    static bool is_vector(const MatArray& array) {
        const auto form = signal_form(array.shape);
        return array.is_number() && form && !form->columns;
    }
    std::size_t signals_in(const std::string& group) const {
        return static_cast<std::size_t>(std::ranges::count_if(arrays_, [&](const MatArray& array) {
            return group_of(array.name, '.') == group && array.is_number() &&
                   std::ranges::any_of(array.shape, [](auto size) { return size > 1; });
        }));
    }
    // The array, or the matrix of "data:2".
    const MatArray* array_of(const std::string& name) const {
        const auto exact = std::ranges::find(arrays_, name, &MatArray::name);
        if (exact != arrays_.end()) {
            return &*exact;
        }
        const auto part = matrix_column(name);
        const auto matrix =
            part ? std::ranges::find(arrays_, part->matrix, &MatArray::name) : arrays_.end();
        return matrix == arrays_.end() ? nullptr : &*matrix;
    }
    // Values of matrices are in columns (MATLAB).
    static std::vector<double> column_of_matrix(const std::vector<double>& all,
                                                const MatArray& array, const SignalForm& form,
                                                std::size_t column) {
        std::size_t time_step = 1, column_step = 1;
        for (std::size_t d = 0; d < array.shape.size(); ++d) {
            time_step *= d < form.time ? array.shape[d] : 1;
            column_step *= d < *form.columns ? array.shape[d] : 1;
        }
        std::vector<double> values;
        for (std::size_t i = 0; i < array.shape[form.time]; ++i) {
            values.push_back(all[i * time_step + column * column_step]);
        }
        return values;
    }
    static std::string text_of(const MatArray& array) {
        const std::string shape = shape_text(array.shape), name = printable(array.name);
        if (array.is_object()) {
            return name + " (table or object)";
        }
        if (array.complex) {
            return fmt::format("{} (complex, {})", name, shape);
        }
        if (!array.is_number()) {
            return fmt::format("{} ({})", name,
                               array.type == MAT_C_CHAR     ? "text"
                               : array.type == MAT_C_SPARSE ? "sparse"
                                                            : "not numbers");
        }
        const auto form = signal_form(array.shape);
        return form && form->columns ? fmt::format("{} ({}; {}:1 to {}:{})", name, shape, name,
                                                   name, array.shape[*form->columns])
                                     : fmt::format("{} ({})", name, shape);
    }
    // Reason why an array cannot be read as a column; "" if it can.
    static std::string problem_of(const MatArray& array) {
        if (array.is_object()) {
            return fmt::format(
                "{} is a table, timetable or object, which is not supported; in MATLAB, save its "
                "columns as a struct: s = table2struct(T, 'ToScalar', true); save('FILE', 's')",
                printable(array.name));
        }
        if (array.complex || array.type == MAT_C_SPARSE) {
            return fmt::format("{} is {}; save a real, full vector", printable(array.name),
                               array.complex ? "complex" : "a sparse matrix");
        }
        if (!array.is_number()) {
            return fmt::format("{} is not a column of numbers", text_of(array));
        }
        return signal_form(array.shape)
                   ? ""
                   : fmt::format(
                         "{} has the shape {}; a column must be a vector, or a column of a "
                         "matrix whose longer dimension is time",
                         printable(array.name), shape_text(array.shape));
    }
    std::string problem_of(const std::string& name) const override {
        const MatArray& array = *array_of(name);
        const std::string problem = problem_of(array);
        const auto form = signal_form(array.shape);
        if (!problem.empty() || !form) {
            return problem;
        }
        const std::size_t columns = form->columns ? array.shape[*form->columns] : 0;
        if (array.name == name) {
            return columns == 0
                       ? ""
                       : fmt::format(
                             "{} is a matrix of {}; choose one of its columns, {}:1 to {}:{}",
                             printable(name), shape_text(array.shape), name, name, columns);
        }
        const auto part = matrix_column(name);
        const std::size_t most = std::max<std::size_t>(columns, 1);
        return part && part->column >= 1 && part->column <= most
                   ? ""
                   : fmt::format("{}: {} has {} columns, counted from 1", printable(name),
                                 printable(array.name), most);
    }

    MatHandle file_;
    std::vector<MatArray> arrays_;
    std::vector<std::string> all_, names_, repeated_;
};

}  // namespace

std::unique_ptr<SignalFile> open_signal_mat(const std::string& path) {
    const SilentHdf5 silent;
    return std::make_unique<SignalMat>(path);
}

}  // namespace gearpod::mc
