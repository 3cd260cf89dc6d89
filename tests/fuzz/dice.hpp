// Random choices of an attack, reproducible by its number.
#pragma once

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <random>

namespace gearpod::test {

class Dice {
  public:
    explicit Dice(std::uint64_t number) : engine_(number) {}
    std::size_t below(std::size_t count) { return count == 0 ? 0 : engine_() % count; }
    template <class List>
    const auto& one_of(const List& list) {
        return list[below(std::size(list))];
    }

  private:
    std::mt19937_64 engine_;
};

}  // namespace gearpod::test
