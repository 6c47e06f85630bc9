#pragma once

#include "structured/files.h"

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace orb::editor {

/// A language server without a transport: JSON messages in, JSON messages out. It holds the open
/// documents and nothing else, reads no clock, and answers every message, however
/// malformed, without throwing.
class LanguageServer {
public:
  /// What programs include is taken from the open documents, then from `disk`; null: no file. It
  /// must outlive the server.
  explicit LanguageServer(structured::Files* disk = nullptr);
  ~LanguageServer();
  LanguageServer(const LanguageServer&) = delete;
  LanguageServer& operator=(const LanguageServer&) = delete;

  /// Takes one message; returns the answer and the notifications that it causes.
  std::vector<std::string> receive(std::string_view message);

  /// What to answer to something that is not a message at all.
  std::vector<std::string> receive_garbage(std::string_view what);

  /// Set once `exit` arrived: whether `shutdown` came before it, as it should.
  std::optional<bool> ended_well() const;

private:
  struct State;
  std::unique_ptr<State> state_;
};

} // namespace orb::editor
