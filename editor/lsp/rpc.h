#pragma once

#include "editor/wording.h"

#include <string>
#include <tl/expected.hpp>
#include <utility>

// Answers to requests of the Language Server Protocol.

namespace orb::editor {

/// Error codes of the protocol.
enum class RpcError : int {
  ParseError = -32700,
  InvalidRequest = -32600,
  MethodNotFound = -32601,
  InvalidParams = -32602,
  InternalError = -32603,
  ServerNotInitialized = -32002,
  RequestFailed = -32803,
  RequestCancelled = -32800,
};

/// Why a request is refused.
struct Refusal {
  RpcError error = RpcError::InvalidParams;
  std::string message;
};

using Answer = tl::expected<Json, Refusal>;

inline tl::unexpected<Refusal> refuse(RpcError error, std::string message) {
  return tl::unexpected(Refusal{error, std::move(message)});
}

} // namespace orb::editor
