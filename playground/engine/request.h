#pragma once

#include "base/exit_code.h"
#include "base/source.h"
#include "base/time.h"
#include "editor/lsp/language_server.h"
#include "playground/engine/sentence_log.h"
#include "run/input.h"
#include "structured/text/files.h"

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

// Requests of a page. playground/README.md describes each one.

namespace orb::playground {

using nlohmann::ordered_json;

/// Why a request failed; `findings` is a document of `orb check --format json`, or empty.
struct Problem {
  ExitCode code = ExitCode::BadInput;
  std::string message;
  std::string findings = {};
};

/// JSON as text.
using Answer = tl::expected<std::string, Problem>;

tl::unexpected<Problem> refuse(const Failure& failure);
tl::unexpected<Problem> refuse(ExitCode code, std::string message);

/// All available files; paths have no leading `/`.
class MemoryFiles final : public structured::Files, public editor::Folders {
public:
  MemoryFiles() = default;
  explicit MemoryFiles(const ordered_json& params);

  std::optional<std::string> read(const std::string& path) override;
  /// Programs, macros and tests, as paths from the root.
  std::vector<std::string> sources(const std::string& root) override;

  /// The first file; empty if there is none.
  std::string first() const { return first_; }

private:
  std::map<std::string, std::string, std::less<>> texts_;
  std::string first_;
};

/// The files of a request, and which of them it is about.
struct Request {
  Request(const ordered_json& given, SentenceLog& kept);

  const ordered_json& params;
  SentenceLog& said; ///< keeps the messages of the answer; outlives the request
  MemoryFiles files;
  std::vector<std::string> names;

  /// The text in member `key`, or `otherwise`.
  std::string text(const char* key, std::string_view otherwise = "") const;
  bool flag(const char* key, bool otherwise = false) const;
  /// A list of texts; a single text is a list of one.
  std::vector<std::string> texts(const char* key) const;
  template <class Value>
  std::optional<Value> value(const char* key) const;

  /// The text of an existing file.
  tl::expected<std::string, Problem> read(const std::string& name);
  /// The sources that the request is about, each with its language.
  tl::expected<std::vector<run::SourceFile>, Problem> sources();
  /// The same, ready for a ball; fails if they have errors.
  tl::expected<std::vector<run::Input>, Problem> inputs();
};

template <class Value>
std::optional<Value> Request::value(const char* key) const {
  const auto found = params.find(key);
  return found == params.end() || found->is_null() ? std::nullopt
                                                   : std::optional(found->get<Value>());
}

/// Serialises JSON; bytes that are not UTF-8 become U+FFFD.
std::string print(const ordered_json& json);

/// Bytes as JSON (engine.js converts them from and to a Uint8Array).
ordered_json bytes_json(ByteView bytes);
Bytes bytes_of(const ordered_json& json);

double milliseconds(Duration t);
Duration duration_of(double milliseconds);

} // namespace orb::playground
