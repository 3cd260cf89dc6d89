// Prints this processor's peak rates, to which the shares in README.md refer: fused multiply-adds
// of doubles, loads and stores of registers, by width.
// Usage: bench_peaks [ROUNDS]
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <vector>

#include "peaks.hpp"

namespace {

using gearpod::bench::Width;

struct Peak {
    const char* name;
    std::function<double(Width)> rate;
};

// Prints medians over interleaved rounds, in 1e9 per second.
void print_peaks(int rounds) {
    const std::vector<Peak> peaks{{"fused multiply-adds", gearpod::bench::fma_rate_double},
                                  {"loads", gearpod::bench::load_rate},
                                  {"stores", gearpod::bench::store_rate}};
    const std::vector<Width> widths{Width::scalar, Width::bits_256, Width::bits_512};
    std::vector<std::vector<double>> rates(peaks.size() * widths.size());
    for (int round = 0; round < rounds; ++round) {
        for (std::size_t i = 0; i < rates.size(); ++i) {
            rates[i].push_back(peaks[i / widths.size()].rate(widths[i % widths.size()]));
        }
    }
    fmt::print("{:<22}{:>10}{:>10}{:>10}   1e9 a second\n", "", "scalar", "256 bit", "512 bit");
    for (std::size_t p = 0; p < peaks.size(); ++p) {
        fmt::print("{:<22}", peaks[p].name);
        for (std::size_t w = 0; w < widths.size(); ++w) {
            std::vector<double>& all = rates[p * widths.size() + w];
            std::sort(all.begin(), all.end());
            const double middle = all[all.size() / 2];
            fmt::print("{:>10}", middle > 0.0 ? fmt::format("{:.2f}", 1e-9 * middle) : "-");
        }
        fmt::print("\n");
    }
}

}  // namespace

int main(int argc, char** argv) {
    const int rounds = argc > 1 ? std::atoi(argv[1]) : 200;
    if (argc > 2 || rounds < 1) {
        fmt::print(stderr, "usage: bench_peaks [ROUNDS]\n");
        return 2;
    }
    print_peaks(rounds);
    return 0;
}
