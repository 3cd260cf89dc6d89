// Sequences of numbers: made by a function and compared; checks on every instruction set.
#pragma once

#include "machine/instruction_sets.hpp"
#include "tests/test.hpp"

namespace gearpod::test {

// Vector of f(item) for each item of a range, in this order.
template <class Range, class Function>
auto mapped(const Range& range, Function f) {
    std::vector<std::decay_t<decltype(f(*std::begin(range)))>> all;
    for (const auto& item : range) {
        all.push_back(f(item));
    }
    return all;
}

// Vector of f(0), f(1), ..., f(count - 1), in this order.
template <class Count, class Function>
auto tabulated(Count count, Function f) {
    return mapped(std::views::iota(Count{0}, count), f);
}

// Every step-th number from the first one on: of a tile with so many lanes, those of one lane.
template <class Numbers>
std::vector<double> every(std::size_t step, const Numbers& numbers, std::size_t first = 0) {
    std::vector<double> some;
    for (std::size_t i = first; i < numbers.size(); i += step) {
        some.push_back(numbers[i]);
    }
    return some;
}

// Independent values of a normal distribution.
inline std::vector<double> normal_values(std::size_t count, unsigned seed, double mean = 0.0,
                                         double deviation = 1.0) {
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> normal(mean, deviation);
    return tabulated(count, [&](std::size_t) { return normal(engine); });
}

// Sine with so many cycles over all points.
inline std::vector<double> sine(double amplitude, int cycles, int points) {
    return tabulated(points, [&](int i) {
        return amplitude * std::sin(2.0 * std::numbers::pi * cycles * i / points);
    });
}

// Largest absolute difference of numbers at the same index; NaN if any number is.
template <class A, class B>
double largest_difference(const A& a, const B& b) {
    REQUIRE(std::size(a) == std::size(b));
    double largest = 0.0;
    for (std::size_t i = 0; i < std::size(a); ++i) {
        const double difference = static_cast<double>(std::abs(a[i] - b[i]));
        if (std::isnan(difference)) {
            return difference;
        }
        largest = std::max(largest, difference);
    }
    return largest;
}

// Largest relative difference of numbers from the expected ones; NaN if any is.
template <class A, class B>
double largest_error(const A& found, const B& expected) {
    REQUIRE(std::size(found) == std::size(expected));
    std::vector<double> ratios;
    for (std::size_t i = 0; i < std::size(found); ++i) {
        ratios.push_back(found[i] / expected[i]);
    }
    return largest_difference(ratios, std::vector<double>(ratios.size(), 1.0));
}

// Checks each number against the expected one, to a share of it and a margin.
template <class A, class B>
void check_close(const A& found, const B& expected, double share, double margin = 0.0) {
    REQUIRE(std::size(found) == std::size(expected));
    for (std::size_t i = 0; i < std::size(found); ++i) {
        INFO(i);
        CHECK(found[i] == Approx(expected[i]).epsilon(share).margin(margin));
    }
}

inline std::vector<double> difference(std::vector<double> a, const std::vector<double>& b) {
    REQUIRE(a.size() == b.size());
    std::ranges::transform(a, b, a.begin(), std::minus<>());
    return a;
}

template <class A>
double largest_magnitude(const A& values) {
    return largest_difference(values, A(values.size(), 0.0));
}

inline double sum_of_squares(const std::vector<double>& values) {
    return std::inner_product(values.begin(), values.end(), values.begin(), 0.0);
}

inline double mean_of(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

inline double rms_of(const std::vector<double>& values) {
    return std::sqrt(sum_of_squares(values) / static_cast<double>(values.size()));
}

// Sums of the squares of samples that are a multiple of `bins` apart.
inline std::vector<double> folded_squares(const std::vector<double>& signal, std::size_t bins) {
    std::vector<double> folded(bins, 0.0);
    for (std::size_t i = 0; i < signal.size(); ++i) {
        folded[i % bins] += signal[i] * signal[i];
    }
    return folded;
}

// Makes a check with each instruction set of this processor, and restores the one in use.
template <class Check>
void for_each_instruction_set(Check check) {
    const machine::InstructionSet active = machine::active_instruction_set();
    for (int set = 0; set <= static_cast<int>(machine::best_instruction_set()); ++set) {
        INFO("instruction set " << set);
        machine::use_instruction_set(static_cast<machine::InstructionSet>(set));
        check();
    }
    machine::use_instruction_set(active);
}

}  // namespace gearpod::test
