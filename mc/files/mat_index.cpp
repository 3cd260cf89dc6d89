#include "mc/files/mat_index.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <functional>
#include <map>
#include <string_view>

#include "mc/files/formats/byte_numbers.hpp"

namespace gearpod::mc {
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

}  // namespace gearpod::mc
