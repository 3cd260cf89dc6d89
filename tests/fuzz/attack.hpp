// Attacks on the built program: inputs and required properties of the outcome.
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace gearpod::test {

// One call of the program and the files in its folder.
struct Attack {
    std::vector<std::string> arguments;
    bool prints_numbers = true;            // all of them must be finite in a success
    std::vector<std::string> inputs = {};  // files that must stay unchanged
    std::string program = {};              // called instead of gearpod
};

// A folder with a study, results, a checkpoint and recordings, all small and valid, from which
// attacks are made. The program creates them once.
struct Arsenal {
    std::string program, folder;
    std::vector<std::string> studies;                            // study texts
    std::string small_study;                                     // path
    std::string results, checkpoint, csv, hdf5, wav, uff, tdms;  // bytes of valid files
    std::vector<std::string> inspections;                        // tables of sizes and outcomes
    std::vector<std::string> gear_units;                         // models in REXS
};

// Writes the files of attack `number` of a kind into `folder`. Deterministic for a given number.
Attack attack_by_study(const Arsenal& arsenal, const std::string& folder, std::uint64_t number);
Attack attack_by_results(const Arsenal& arsenal, const std::string& folder, std::uint64_t number);
Attack attack_by_checkpoint(const Arsenal& arsenal, const std::string& folder,
                            std::uint64_t number);
Attack attack_by_signal(const Arsenal& arsenal, const std::string& folder, std::uint64_t number);
Attack attack_by_table(const Arsenal& arsenal, const std::string& folder, std::uint64_t number);
Attack attack_by_rexs(const Arsenal& arsenal, const std::string& folder, std::uint64_t number);
Attack attack_by_roles(const Arsenal& arsenal, const std::string& folder, std::uint64_t number);
Attack attack_by_options(const Arsenal& arsenal, const std::string& folder, std::uint64_t number);

}  // namespace gearpod::test
