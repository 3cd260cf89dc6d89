// Python process that runs the user's features (analysis/python/gearpod/worker.py). Whatever the
// user's code does, only that process is affected.
#pragma once

#include <sys/types.h>

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include "mc/files/atomic_file.hpp"
#include "mc/files/child_process.hpp"
#include "mc/files/input/python_hashes.hpp"

namespace gearpod::mc {

// Feature in a Python file.
struct PythonFunction {
    std::string name, title, unit, alarm, uses, doc;
    std::string samples;  // "no" if it needs no samples of the sensor
};
struct PythonFile {
    PythonHashes hashes;
    std::vector<PythonFunction> functions;
};

class PythonWorker {
  public:
    // The worker of the calling thread. It starts with the first use, and again after it has ended.
    static PythonWorker& of_thread();

    // Seconds that all threads of this process have waited for replies so far.
    static double waited_s();

    // Starts the interpreter that GEARPOD_PYTHON names, by default /usr/bin/python3.
    PythonWorker();
    PythonWorker(const PythonWorker&) = delete;
    PythonWorker& operator=(const PythonWorker&) = delete;
    ~PythonWorker() { end(); }

    // Runs the file at this absolute path and returns its features. Throws PythonError if the file
    // cannot be used.
    PythonFile load(const std::string& path);
    // Runs the file unless this was done before. Throws PythonError if a hash differs.
    void require(const std::string& path, const PythonHashes& hashes);

    // Sends a request, waits for its reply and returns the reply's values. `work` says in messages
    // what is computed. Throws PythonError if the worker refuses the request or ends. Throws
    // machine::Cancelled if computations are cancelled; the object is then unusable.
    std::vector<double> ask(const nlohmann::json& request, std::span<const double> values,
                            const std::string& work, nlohmann::json& reply);

  private:
    PythonFile load(const std::string& path, const PythonHashes* expected);
    void wait_for_reply(const std::string& work);
    [[noreturn]] void report_end(const std::string& work);
    int end();  // returns the status of waitpid()

    Descriptor here_{-1};
    pid_t child_ = -1;
    std::map<std::string, PythonHashes> loaded_;  // by path
};

}  // namespace gearpod::mc
