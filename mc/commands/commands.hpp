// Commands of the program. Each add_NAME() adds a command with its options to the command line;
// when arguments are parsed, the command runs and stores its exit code
// (mc/library/run/run_options.hpp) in `code`.
#pragma once

#include <CLI/CLI.hpp>

namespace gearpod::mc {

#define GEARPOD_COMMAND(name) void add_##name(CLI::App& app, int& code);
#include "mc/commands/commands.def"
#undef GEARPOD_COMMAND

}  // namespace gearpod::mc
