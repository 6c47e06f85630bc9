#include "cli/editors/word_lists.h"

#include "base/bytes.h"
#include "disk/disk.h"
#include "editor/printed/syntax_files.h"

#include <filesystem>
#include <system_error>

namespace orb::cli {

void write_editor_files(Context& context, const std::string& folder) {
  for (const auto& file : editor::syntax_files()) {
    const auto path = disk::as_path(folder) / disk::as_path(file.path);
    std::error_code error;
    std::filesystem::create_directories(path.parent_path(), error); // a failure shows when writing
    if (const auto done = disk::write(path.string(), as_bytes(file.text)); !done)
      return fail(context, {ExitCode::File, done.error().message});
  }
}

} // namespace orb::cli
