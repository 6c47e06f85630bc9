#pragma once

// The answers of the language server about what editor/languages/shape.h knows, in the protocol's
// words.

#include "editor/languages/shape.h"
#include "editor/wording.h"

#include <string>
#include <string_view>
#include <vector>

namespace orb::editor {

/// What the server offers of it: members for its capabilities.
Json shape_capabilities();

/// Colours as the protocol packs them: five numbers each, counted from the one before. Only those
/// that touch `within`.
Json pack_colors(const Wording& words, const Source& source, const std::vector<Colored>& colors,
                 Span within);

Json list_folds(const std::vector<Fold>& folds);

/// The chain of ranges around one place, from inside out.
Json nest_ranges(const Wording& words, const Source& source, const std::vector<Span>& chain);

Json describe(const Signature& signature);

Json list_links(const Wording& words, const Source& source, const std::vector<Link>& links);

/// Commands that the editor has: `orb.run`, `orb.debug` with the file; `orb.runTest`,
/// `orb.debugTest` with the file and the name of the test, which is empty for all.
Json list_lenses(const Wording& words, const std::string& uri, const Source& source,
                 const std::vector<Lens>& lenses);

/// Whether the letters of `query` stand in `name` in their order; all names have those of none.
bool answers_to(std::string_view name, std::string_view query);

} // namespace orb::editor
