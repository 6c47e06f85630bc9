#pragma once

#include "editor/wording.h"

#include <string>
#include <tl/expected.hpp>
#include <utility>

// What a request of the Language Server Protocol is answered with.

namespace orb::editor {

/// Numbers of the protocol.
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

/// Why a request is not answered.
struct Refusal {
  RpcError error = RpcError::InvalidParams;
  std::string message;
};

using Answer = tl::expected<Json, Refusal>;

inline tl::unexpected<Refusal> refuse(RpcError error, std::string message) {
  return tl::unexpected(Refusal{error, std::move(message)});
}

} // namespace orb::editor
