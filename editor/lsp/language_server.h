#pragma once

#include "base/render.h"
#include "structured/text/files.h"

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace orb::editor {

/// The workspace folders of an editor.
class Folders {
public:
  virtual ~Folders() = default;

  /// The paths of programs, macros and tests below `root`, sorted, up to a limit.
  virtual std::vector<std::string> sources(const std::string& root) = 0;
};

/// A language server without a transport: JSON messages in, JSON messages out. Its only state is
/// the open documents. It reads no clock, and answers every message, however malformed, without
/// throwing.
class LanguageServer {
public:
  /// Reads included files from the open documents, then from `disk`; null: no files. Both must
  /// outlive the server. `say` words the findings.
  explicit LanguageServer(structured::Files* disk = nullptr, Folders* folders = nullptr,
                          Say say = &in_english);
  ~LanguageServer();
  LanguageServer(const LanguageServer&) = delete;
  LanguageServer& operator=(const LanguageServer&) = delete;

  /// Handles one message; returns the answer and the resulting notifications.
  std::vector<std::string> receive(std::string_view message);

  /// The same in two steps, so that a cancellation can overtake: take() queues, answer_next()
  /// answers. A request cancelled in between is answered without doing the work.
  void take(std::string_view message);
  /// Queues input that is not a message.
  void take_garbage(std::string_view what);
  bool has_waiting() const;
  /// Answers the oldest queued message.
  std::vector<std::string> answer_next();

  /// Returns the answer to input that is not a message.
  std::vector<std::string> receive_garbage(std::string_view what);

  /// Set once `exit` arrived: true if `shutdown` came first, as required.
  std::optional<bool> ended_well() const;

private:
  std::vector<std::string> answer_all();

  struct Impl;
  std::unique_ptr<Impl> impl_;
};

} // namespace orb::editor
