// Checks that a program keeps its own sin and exp when it links the library: the functions that it
// calls, and those that other libraries of the process find, must lie in libm.
#include <dlfcn.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <gearpod/stiffness/additive_mesh.hpp>

namespace {

bool lies_in_libm(const char* name, const void* function) {
    Dl_info place{};
    const bool found = function != nullptr && dladdr(function, &place) != 0;
    if (found && std::strstr(place.dli_fname, "libm") != nullptr) {
        return true;
    }
    std::fprintf(stderr, "%s is that of %s\n", name, found ? place.dli_fname : "nothing");
    return false;
}

}  // namespace

int main() {
    using namespace gearpod;
    const gears::MeshGeometry pair({19, false, 3.175e-3, 0.35}, {48, false, 3.175e-3, 0.35});
    const stiffness::AdditiveMesh mesh(pair, {2.068e11, 0.3, 0.016},
                                       stiffness::Profile::root_circle);
    bool good = mesh.contact_ratio() > 1;
    using Function = double (*)(double);
    const struct {
        const char* name;
        Function called;
    } functions[] = {{"sin", &::sin}, {"cos", &::cos}, {"exp", &::exp}, {"log", &::log}};
    for (const auto& [name, called] : functions) {
        good = lies_in_libm(name, reinterpret_cast<const void*>(called)) && good;
        good = lies_in_libm(name, dlsym(RTLD_DEFAULT, name)) && good;
    }
    return good ? 0 : 1;
}
