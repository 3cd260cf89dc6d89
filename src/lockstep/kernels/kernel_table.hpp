// The kernels of this program: a function for every way in which a mesh period of W gearboxes can
// be marched. CMake makes them, one file for each line of integrators.def, kind of kernel, mesh law
// and instruction set (kernels.cmake).
#pragma once

#include <compare>
#include <map>
#include <span>
#include <stdexcept>
#include <string>
#include <typeindex>
#include <vector>

#include "lockstep/plan/march.hpp"
#include "machine/dispatch.hpp"

namespace gearpod::lockstep {

// What moves: the motions that explicit integrators march, or the matrices of any gearbox that
// implicit ones take.
enum class Moving { translational_inertial, translational, torsional, fixed_shaft, matrices };
// What drives it: load and speed that stay, forces that vary, or a speed that varies (and such
// forces).
enum class Drive { steady, forced, paced };

struct KernelKey {
    Integrator integrator{};
    dynamics::MeshLaw law{};
    Drive drive{};
    Precision precision{};
    machine::InstructionSet set{};
    Moving moving{};
    int lanes = 0;

    auto operator<=>(const KernelKey&) const = default;
};

// The program has no kernel of that instruction set or width.
class NoSuchKernel : public std::invalid_argument {
  public:
    using std::invalid_argument::invalid_argument;
};

class KernelTable {
  public:
    template <class Lanes>
    void add(const KernelKey& key, MarchKernel<Lanes>* kernel) {
        add(key, {typeid(Lanes), reinterpret_cast<Function>(kernel)});
    }

    // Of the key's instruction set, or the next one below it that has so many lanes. Throws
    // NoSuchKernel.
    template <class Lanes>
    MarchKernel<Lanes>* find(const KernelKey& key) const {
        return reinterpret_cast<MarchKernel<Lanes>*>(find(key, typeid(Lanes)));
    }

    // All keys, in order.
    std::vector<KernelKey> keys() const;

  private:
    using Function = void (*)();
    struct Entry {
        std::type_index lanes;
        Function kernel;
    };
    void add(const KernelKey& key, const Entry& entry);
    Function find(KernelKey key, std::type_index lanes) const;

    std::map<KernelKey, Entry> kernels_;
};

// Made at its first use.
const KernelTable& kernel_table();

// The instruction sets and the numbers of lanes that the program has kernels for, ascending.
std::vector<machine::InstructionSet> built_instruction_sets();
std::vector<int> built_lanes(Precision precision);
// "1 or 8 doubles or 1 or 16 singles abreast for x86-64-v4"
std::string built_kernels();

// Each adds the kernels of a file that CMake makes.
using KernelAdder = void (*)(KernelTable&);
std::span<const KernelAdder> kernel_adders();

}  // namespace gearpod::lockstep
