#pragma once

// The protocol's JSON for what editor/languages/shape.h finds in a text.

#include "editor/languages/shape.h"
#include "editor/wording.h"

#include <string>
#include <string_view>
#include <vector>

namespace orb::editor {

/// The capabilities that the server announces for it.
Json shape_capabilities();

/// Packs colours as the protocol does: five numbers each, relative to the previous one. Only those
/// that touch `within`.
Json pack_colors(const Wording& words, const Source& source, const std::vector<Colored>& colors,
                 Span within);

Json list_folds(const std::vector<Fold>& folds);

/// Selection ranges at one place, from inside out.
Json nest_ranges(const Wording& words, const Source& source, const std::vector<Span>& chain);

Json describe(const Signature& signature);

Json list_links(const Wording& words, const Source& source, const std::vector<Link>& links);

/// Commands of the editor: `orb.run`, `orb.debug` with the file; `orb.runTest`, `orb.debugTest`
/// with the file and the name of the test, empty for all.
Json list_lenses(const Wording& words, const std::string& uri, const Source& source,
                 const std::vector<Lens>& lenses);

/// True if `name` contains the letters of `query` in their order; an empty query matches every
/// name.
bool answers_to(std::string_view name, std::string_view query);

} // namespace orb::editor
