#pragma once

#include "base/message.h"

#include <optional>
#include <string>
#include <string_view>

namespace orb::structured {

/// Where included sources and macro files come from: the disk, an editor's buffers, a web page.
class Files {
public:
  virtual ~Files() = default;

  /// The text of `path`, or nothing where it cannot be read.
  virtual std::optional<std::string> read(const std::string& path) = 0;

  /// What `path` is that it is not read: `a pipe`, `a device`; empty for a file, and for nothing.
  virtual Message obstacle(const std::string& path);

  /// Why `path` cannot be read.
  virtual Message trouble(const std::string& path);

  /// What two paths of one file have in common.
  virtual std::string identity(const std::string& path);
};

/// No file at all.
class NoFiles final : public Files {
public:
  std::optional<std::string> read(const std::string&) override { return std::nullopt; }
};

/// `path` as it is written in the file `from`: its folder, `/`, the path, without `./` and with
/// `name/../` folded, so that a file mostly has one path. Absolute paths stay.
std::string resolve_path(std::string_view from, std::string_view path);

} // namespace orb::structured
