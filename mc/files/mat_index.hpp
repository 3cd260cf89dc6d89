// Arrays of a MAT file, also within structs and cells, by name.
#pragma once

#include <matio.h>

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

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

}  // namespace gearpod::mc
