#pragma once

#include "base/exit_code.h"
#include "base/source.h"
#include "base/time.h"
#include "editor/lsp/language_server.h"
#include "playground/engine/said.h"
#include "run/input.h"
#include "structured/text/files.h"

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

// What a page asks for, read. playground/README.md has the form of every request.

namespace orb::playground {

using nlohmann::ordered_json;

/// Why a request is not answered; `findings` is a document of `orb check --format json`, or empty.
struct Problem {
  ExitCode code = ExitCode::BadInput;
  std::string message;
  std::string findings = {};
};

/// JSON as text.
using Answer = tl::expected<std::string, Problem>;

tl::unexpected<Problem> refuse(const Failure& failure);
tl::unexpected<Problem> refuse(ExitCode code, std::string message);

/// All files that there are: a path has no `/` in front.
class MemoryFiles final : public structured::Files, public editor::Folders {
public:
  MemoryFiles() = default;
  explicit MemoryFiles(const ordered_json& params);

  std::optional<std::string> read(const std::string& path) override;
  /// Programs, macros and tests, as paths from the root.
  std::vector<std::string> sources(const std::string& root) override;

  /// The first of all; empty where there is none.
  std::string first() const { return first_; }

private:
  std::map<std::string, std::string, std::less<>> texts_;
  std::string first_;
};

/// The files of a request and which of them are meant.
struct Request {
  Request(const ordered_json& given, Said& kept);

  const ordered_json& params;
  Said& said; ///< keeps what the answer says; outlives the request
  MemoryFiles files;
  std::vector<std::string> names;

  /// The text of the member `key`, or `otherwise`.
  std::string text(const char* key, std::string_view otherwise = "") const;
  bool flag(const char* key, bool otherwise = false) const;
  /// A list of texts; one text is a list, too.
  std::vector<std::string> texts(const char* key) const;
  template <class Value>
  std::optional<Value> value(const char* key) const;

  /// The text of a file that is there.
  tl::expected<std::string, Problem> read(const std::string& name);
  /// The sources that are meant, each in its language.
  tl::expected<std::vector<run::SourceFile>, Problem> sources();
  /// The same, ready for a ball: without mistakes.
  tl::expected<std::vector<run::Input>, Problem> inputs();
};

template <class Value>
std::optional<Value> Request::value(const char* key) const {
  const auto found = params.find(key);
  return found == params.end() || found->is_null() ? std::nullopt
                                                   : std::optional(found->get<Value>());
}

/// JSON that is fit to be sent: bytes that are no text become U+FFFD.
std::string print(const ordered_json& json);

/// Bytes as a page takes and gives them (engine.js makes a Uint8Array of it).
ordered_json bytes_json(ByteView bytes);
Bytes bytes_of(const ordered_json& json);

double milliseconds(Duration t);
Duration duration_of(double milliseconds);

} // namespace orb::playground
