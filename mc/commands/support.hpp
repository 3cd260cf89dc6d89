// What several commands share: reading a study, printing problems, writing text.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "mc/commands/commands.hpp"
#include "mc/scene/scene.hpp"

namespace gearpod::mc {

// Prints every problem on stderr, one a line.
void print_problems(const Problems& problems);

// The study, or nothing after its problems were printed.
std::optional<Study> load_study(const StudyOptions& options);

// The scene of a study, or nothing and why; also sets the kernels' instruction set.
std::unique_ptr<Scene> make_scene(const StudyOptions& options, Problems& problems);

// The same for a study that has been read; problems name it `name`.
std::unique_ptr<Scene> make_scene(const std::string& name, StudyReading reading,
                                  Problems& problems);

// The scene of a study, or nothing after its problems were printed; also sets the kernels'
// instruction set.
std::unique_ptr<Scene> load_scene(const StudyOptions& options);

// Prints why `path` cannot be written, if so.
bool can_write(const std::string& path);

// Writes to a file, or to standard output for "-". False after a message if the file fails.
bool write_text_to(const std::string& path, const std::string& text);

}  // namespace gearpod::mc
