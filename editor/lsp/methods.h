#pragma once

#include "editor/lsp/rpc.h"
#include "editor/lsp/workspace.h"

#include <cstdint>
#include <string>
#include <string_view>

// The requests about a document and their answers: a row each in methods.cpp.

namespace orb::editor {

/// What a request about an open document is answered from.
struct Asked {
  const std::string& uri;
  const Document& document;
  const Json& params;
  std::uint32_t at = 0; ///< where the request has a position
};

/// A request about an open document.
struct Method {
  std::string_view name;
  bool has_position = false;
  Answer (*answer)(const Workspace& space, const Asked& asked);
};

/// Null for a method that is not known.
const Method* find_method(std::string_view name);

/// What the server tells a client that it can do. `encoding` is that of positions.
Json capabilities(std::string_view encoding);

// What a name means, and where it stands.
Answer definition(const Workspace& space, const Asked& asked);
Answer references(const Workspace& space, const Asked& asked);
Answer highlight(const Workspace& space, const Asked& asked);
Answer prepare_rename(const Workspace& space, const Asked& asked);
Answer rename(const Workspace& space, const Asked& asked);
Answer symbols(const Workspace& space, const Asked& asked);

// What is said of a text, and written for the user.
Answer hover(const Workspace& space, const Asked& asked);
Answer completion(const Workspace& space, const Asked& asked);
Answer format(const Workspace& space, const Asked& asked);
Answer hints(const Workspace& space, const Asked& asked);
Answer code_actions(const Workspace& space, const Asked& asked);

// What the shape of a text says.
Answer all_colors(const Workspace& space, const Asked& asked);
Answer colors_within(const Workspace& space, const Asked& asked);
Answer folds(const Workspace& space, const Asked& asked);
Answer selections(const Workspace& space, const Asked& asked);
Answer signature(const Workspace& space, const Asked& asked);
Answer links(const Workspace& space, const Asked& asked);
Answer lenses(const Workspace& space, const Asked& asked);

// Who calls whom.
Answer callables(const Workspace& space, const Asked& asked);

/// Who calls an item that `callables` has answered with, or whom it calls.
Answer calls(const Workspace& space, const Json& params, bool incoming);

/// The outlines of what is open, then of what lies in the open folders.
Answer workspace_symbols(const Workspace& space, const std::string& query);

// What several of them say.
bool overlap(Span a, Span b);
int symbol_kind(OutlineKind kind);
Json workspace_edit(const std::string& uri, Json list);

} // namespace orb::editor
