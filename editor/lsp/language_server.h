#pragma once

#include "base/render.h"
#include "structured/text/files.h"

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace orb::editor {

/// The folders that an editor has open.
class Folders {
public:
  virtual ~Folders() = default;

  /// The paths of the programs, macros and tests below `root`, bounded in number, in order.
  virtual std::vector<std::string> sources(const std::string& root) = 0;
};

/// A language server without a transport: JSON messages in, JSON messages out. It holds the open
/// documents and nothing else, reads no clock, and answers every message, however
/// malformed, without throwing.
class LanguageServer {
public:
  /// What programs include is taken from the open documents, then from `disk`; null: no file. Both
  /// must outlive the server. `say`: how findings are said.
  explicit LanguageServer(structured::Files* disk = nullptr, Folders* folders = nullptr,
                          Say say = &in_english);
  ~LanguageServer();
  LanguageServer(const LanguageServer&) = delete;
  LanguageServer& operator=(const LanguageServer&) = delete;

  /// Takes one message; returns the answer and the notifications that it causes.
  std::vector<std::string> receive(std::string_view message);

  /// The same in two steps, so that a message can overtake: taken now, answered when its turn
  /// comes. A request that is cancelled before that is answered so, without the work.
  void take(std::string_view message);
  /// Something that is not a message at all.
  void take_garbage(std::string_view what);
  bool has_waiting() const;
  /// Answers the oldest message that waits.
  std::vector<std::string> answer_next();

  /// What to answer to such a thing.
  std::vector<std::string> receive_garbage(std::string_view what);

  /// Set once `exit` arrived: whether `shutdown` came before it, as it should.
  std::optional<bool> ended_well() const;

private:
  std::vector<std::string> answer_all();

  struct State;
  std::unique_ptr<State> state_;
};

} // namespace orb::editor
