#include "mc/files/python/python_program.hpp"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>

namespace gearpod::mc {
namespace {

// Unnamed temporary file, deleted when it is closed.
using UnnamedFile = std::unique_ptr<FILE, int (*)(FILE*)>;

UnnamedFile unnamed_file(const std::string& text) {
    UnnamedFile file(std::tmpfile(), std::fclose);
    if (!file || std::fwrite(text.data(), 1, text.size(), file.get()) != text.size() ||
        std::fflush(file.get()) != 0 || lseek(fileno(file.get()), 0, SEEK_SET) != 0) {
        throw PythonError(std::string("no temporary file: ") + std::strerror(errno));
    }
    return file;
}

std::string content(FILE* file) {
    std::rewind(file);
    std::string text;
    std::array<char, 65536> buffer;
    while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), file)) {
        text.append(buffer.data(), count);
    }
    return text;
}

// Exit code of the process, or 128 plus the number of the signal that ended it.
int run(const std::vector<std::string>& words, FILE* input, FILE* output) {
    std::vector<char*> arguments;
    for (const std::string& word : words) {
        arguments.push_back(const_cast<char*>(word.c_str()));
    }
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t streams;
    posix_spawn_file_actions_init(&streams);
    posix_spawn_file_actions_adddup2(&streams, fileno(input), STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&streams, fileno(output), STDOUT_FILENO);
    pid_t child = 0;
    const int error =
        posix_spawn(&child, words[0].c_str(), &streams, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&streams);
    if (error != 0) {
        throw PythonError(words[0] + ": " + std::strerror(error) +
                          "; install python3, or name another Python 3 in GEARPOD_PYTHON");
    }
    int status = 0;
    while (waitpid(child, &status, 0) < 0) {
        if (errno != EINTR) {
            throw PythonError(std::strerror(errno));
        }
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

std::string python_interpreter() {
    const char* given = std::getenv("GEARPOD_PYTHON");
    return given != nullptr && *given != '\0' ? given : "/usr/bin/python3";
}

PythonOutput run_python(const std::vector<std::string>& arguments, const std::string& input) {
    std::vector<std::string> words{python_interpreter()};
    words.insert(words.end(), arguments.begin(), arguments.end());
    const UnnamedFile in = unnamed_file(input), out = unnamed_file("");
    const int code = run(words, in.get(), out.get());
    return {code, content(out.get())};
}

}  // namespace gearpod::mc
