// Runs the readers under libFuzzer, one per program (GEARPOD_FUZZ_READER). Input may be refused
// with the reader's own exception; any other outcome is a failure.
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "mc/ensemble/results_check.hpp"
#include "mc/files/signal_file.hpp"
#include "mc/recordings/manifest.hpp"
#include "mc/report/run_report.hpp"
#include "mc/results/result_rows.hpp"
#include "mc/study/study.hpp"
#include "tests/mc/edited_results.hpp"

namespace {

using namespace gearpod;
using namespace gearpod::mc;

// A file with these bytes, reused by all calls; HDF5 needs a named file. Fastest in memory:
// TMPDIR=/dev/shm.
class InputFile {
  public:
    InputFile()
        : path_((std::filesystem::temp_directory_path() / "gearpod-fuzz-XXXXXX").string()),
          fd_(mkstemp(path_.data())) {}
    ~InputFile() { std::filesystem::remove(path_); }
    const std::string& with(const std::string& bytes) const {
        if (ftruncate(fd_, 0) != 0 ||
            pwrite(fd_, bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
            std::abort();
        }
        return path_;
    }

  private:
    std::string path_;
    int fd_;
};
const std::string& file_of(const std::string& bytes) {
    static const InputFile file;
    return file.with(bytes);
}

// Reads a study and checks that its resolved text gives the same study.
[[maybe_unused]] void study(const std::string& text) {
    const StudyReading reading = read_study_text(text, "fuzz.toml");
    if (!reading.study) {
        if (reading.problems.empty()) {
            std::abort();
        }
        return;
    }
    const StudyReading again = read_study_text(resolved_text(*reading.study), "resolved");
    if (!again.study || !(*again.study == *reading.study)) {
        std::abort();
    }
}

// Replaces the study of a small valid results file (GEARPOD_RESULTS) and updates its checksum.
[[maybe_unused]] void embedded(const std::string& text) {
    static const std::string genuine = [] {
        const char* const path = std::getenv("GEARPOD_RESULTS");
        std::ifstream stream(path == nullptr ? "" : path, std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(stream), {});
    }();
    if (genuine.empty()) {
        std::fputs("GEARPOD_RESULTS must name a results file\n", stderr);
        std::exit(2);
    }
    const std::string& path = file_of(genuine);
    try {
        test::edit_results(path, [&](hid_t root) {
            check(H5Adelete(root, "study"), "study");
            write_text(root, ".", "study", text);
        });
    } catch (const Hdf5Error&) {
        return;  // HDF5 cannot hold this text
    }
    try {
        Results results = read_frame(path);
        const FileRows rows(path, results);
        check_results(path, results, rows);
        results.detection = detect_all(results, rows);
        static_cast<void>(report_text(results_report(results, rows, std::nullopt)));
    } catch (const std::runtime_error&) {
    }
}

template <class Open>
[[maybe_unused]] void signal(const std::string& bytes, Open open) {
    try {
        const auto file = open(file_of(bytes));
        for (const std::string& name : file->names()) {
            try {
                static_cast<void>(file->read(name));
                static_cast<void>(file->unit(name));
            } catch (const SignalError&) {
            }
        }
        static_cast<void>(file->sampling_Hz());
    } catch (const SignalError&) {
    }
}

[[maybe_unused]] void csv(const std::string& bytes) {
    signal(bytes, open_signal_csv);
}
[[maybe_unused]] void hdf5(const std::string& bytes) {
    signal(bytes, [](const std::string& path) { return open_signal_hdf5(path, std::nullopt); });
}

[[maybe_unused]] void manifest(const std::string& bytes) {
    try {
        Problems problems;
        static_cast<void>(read_manifest(file_of(bytes), problems));
    } catch (const SignalError&) {
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    GEARPOD_FUZZ_READER({reinterpret_cast<const char*>(data), size});
    return 0;
}
