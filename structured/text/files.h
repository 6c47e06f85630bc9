#pragma once

#include "base/message.h"

#include <optional>
#include <string>
#include <string_view>

namespace orb::structured {

/// The source of included files and macro files: the disk, an editor's buffers, a web page.
class Files {
public:
  virtual ~Files() = default;

  /// The text of `path`; nothing if it cannot be read.
  virtual std::optional<std::string> read(const std::string& path) = 0;

  /// Why `path` is not read although it exists: `a pipe`, `a device`; empty for a regular or
  /// missing file.
  virtual Message obstacle(const std::string& path);

  /// Why `path` cannot be read.
  virtual Message trouble(const std::string& path);

  /// A key that is equal for all paths of the same file.
  virtual std::string identity(const std::string& path);
};

/// A source without files.
class NoFiles final : public Files {
public:
  std::optional<std::string> read(const std::string&) override { return std::nullopt; }
};

/// Resolves `path` as written in the file `from`: prepends its folder, and folds `./` and
/// `name/../`, so that a file usually has one path. Absolute paths stay.
std::string resolve_path(std::string_view from, std::string_view path);

} // namespace orb::structured
