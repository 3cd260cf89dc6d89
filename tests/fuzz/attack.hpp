// Attacks on the built program: what is given to it, and what it must not answer.
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace gearpod::test {

// One call of the program, and what it finds in its folder.
struct Attack {
    std::vector<std::string> arguments;
    bool prints_numbers = true;            // of which none may be infinite when it ends well
    std::vector<std::string> inputs = {};  // files that it must leave as they are
};

// A folder with a study, results, a checkpoint, and recordings, all small and genuine, that attacks
// are made from; made once by the program itself.
struct Arsenal {
    std::string program, folder;
    std::vector<std::string> studies;                           // texts
    std::string small_study;                                    // its path
    std::string results, checkpoint, csv, hdf5, mat, wav, uff;  // bytes of genuine files
    std::vector<std::string> inspections;                       // tables of sizes and answers
};

// Writes a MAT file of a sensor's signal and a transmission error; its bytes.
std::string genuine_mat(const std::string& path);

// Writes the files of attack `number` of a kind into `folder`. The same for the same number.
Attack attack_by_study(const Arsenal& arsenal, const std::string& folder, std::uint64_t number);
Attack attack_by_results(const Arsenal& arsenal, const std::string& folder, std::uint64_t number);
Attack attack_by_checkpoint(const Arsenal& arsenal, const std::string& folder,
                            std::uint64_t number);
Attack attack_by_signal(const Arsenal& arsenal, const std::string& folder, std::uint64_t number);
Attack attack_by_table(const Arsenal& arsenal, const std::string& folder, std::uint64_t number);
Attack attack_by_roles(const Arsenal& arsenal, const std::string& folder, std::uint64_t number);

}  // namespace gearpod::test
