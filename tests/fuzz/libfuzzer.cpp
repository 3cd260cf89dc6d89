// Readers under libFuzzer, one kind a program (GEARPOD_FUZZ_KIND: 0 study text, 1 CSV, 2 MAT,
// 3 HDF5). What is read may be refused in the reader's own words and nothing else may happen.
#include <sys/mman.h>
#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "mc/files/signal_file.hpp"
#include "mc/study/study.hpp"

namespace {

using namespace gearpod::mc;

// Its resolved text reads to the same study.
void read_study(const std::string& text) {
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

void read_all(SignalFile& file) {
    for (const std::string& name : file.names()) {
        try {
            static_cast<void>(file.read(name));
        } catch (const SignalError&) {
        }
    }
    static_cast<void>(file.sampling_Hz());
}

[[maybe_unused]] void read_signal(const std::uint8_t* data, std::size_t size) {
    static const int fd = memfd_create("signal", 0);
    if (ftruncate(fd, 0) != 0 || pwrite(fd, data, size, 0) != static_cast<ssize_t>(size)) {
        std::abort();
    }
    const std::string path = "/proc/self/fd/" + std::to_string(fd);
    constexpr decltype(&open_signal_csv) kOpen[] = {open_signal_csv, open_signal_mat,
                                                    open_signal_hdf5};
    try {
        read_all(*kOpen[GEARPOD_FUZZ_KIND > 0 ? GEARPOD_FUZZ_KIND - 1 : 0](path));
    } catch (const SignalError&) {
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if constexpr (GEARPOD_FUZZ_KIND == 0) {
        read_study({reinterpret_cast<const char*>(data), size});
    } else {
        read_signal(data, size);
    }
    return 0;
}
