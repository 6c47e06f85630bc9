#pragma once

#include "editor/lsp/rpc.h"
#include "editor/lsp/workspace.h"

#include <cstdint>
#include <string>
#include <string_view>

// Requests about a document, one row each in methods.cpp.

namespace orb::editor {

/// The context of a request about an open document.
struct Asked {
  const std::string& uri;
  const Document& document;
  const Json& params;
  std::uint32_t at = 0; ///< if the request has a position
};

/// A request about an open document.
struct Method {
  std::string_view name;
  bool has_position = false;
  Answer (*answer)(const Workspace& space, const Asked& asked);
};

/// Returns null for an unknown method.
const Method* find_method(std::string_view name);

/// The capabilities that the server announces. `encoding` is that of positions.
Json capabilities(std::string_view encoding);

// Names.
Answer definition(const Workspace& space, const Asked& asked);
Answer references(const Workspace& space, const Asked& asked);
Answer highlight(const Workspace& space, const Asked& asked);
Answer prepare_rename(const Workspace& space, const Asked& asked);
Answer rename(const Workspace& space, const Asked& asked);
Answer symbols(const Workspace& space, const Asked& asked);

// Hover, completion and formatting.
Answer hover(const Workspace& space, const Asked& asked);
Answer completion(const Workspace& space, const Asked& asked);
Answer format(const Workspace& space, const Asked& asked);
Answer hints(const Workspace& space, const Asked& asked);
Answer code_actions(const Workspace& space, const Asked& asked);

// Shape.
Answer all_colors(const Workspace& space, const Asked& asked);
Answer colors_within(const Workspace& space, const Asked& asked);
Answer folds(const Workspace& space, const Asked& asked);
Answer selections(const Workspace& space, const Asked& asked);
Answer signature(const Workspace& space, const Asked& asked);
Answer links(const Workspace& space, const Asked& asked);
Answer lenses(const Workspace& space, const Asked& asked);

// Calls.
Answer callables(const Workspace& space, const Asked& asked);

/// The callers of an item from `callables`, or what it calls.
enum class Related : std::uint8_t { Callers, Callees };
Answer calls(const Workspace& space, const Json& params, Related wanted);

/// The outlines of open documents, then of files in the open folders.
Answer workspace_symbols(const Workspace& space, const std::string& query);

// Shared helpers.
bool overlap(Span a, Span b);
int symbol_kind(OutlineKind kind);
Json workspace_edit(const std::string& uri, Json list);

} // namespace orb::editor
