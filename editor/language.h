#pragma once

// What an editor may ask about a text, without any protocol: places are bytes of a Source. The
// languages answer in editor/languages/, each on its own shelf (language.cpp).

#include "base/diagnostic.h"
#include "base/source.h"
#include "spec/basic.h"
#include "structured/text/files.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

namespace orb::editor {

/// What programs are checked for, and the files around them.
struct LanguageOptions {
  spec::BasicVersion target = spec::default_basic_version;
  structured::Files* files = nullptr; ///< what programs include; null: no file at all
  std::vector<const Source*> open;    ///< structured programs, which may include each other
};

struct Hover {
  Span span;
  std::string markdown;
};

enum class SuggestionKind : std::uint8_t { Keyword, Function, Variable, Value, Line, Rule, Name };

struct Suggestion {
  std::string label;
  SuggestionKind kind = SuggestionKind::Keyword;
  std::string detail;   ///< a line beside the label
  std::string markdown; ///< what an editor shows for the chosen one
};

struct Suggestions {
  Span replaces; ///< the part of a word that is typed already
  std::vector<Suggestion> items;
};

enum class OutlineKind : std::uint8_t { Function, Constant, Array };

/// A line of the outline: a subroutine, a macro.
struct Symbol {
  std::string name;
  std::string detail;
  Span span;      ///< all of it
  Span selection; ///< its name
  OutlineKind kind = OutlineKind::Function;
};

/// A place in another file, which the text includes or which includes it.
struct FarPlace {
  std::shared_ptr<const Source> source; ///< its name is a path, or the name of an open text
  Span span;
  bool defines = false;
};

/// A name in a text: a line number, a variable, a macro.
struct Occurrences {
  std::vector<Span> definitions;
  std::vector<Span> uses;
  std::vector<FarPlace> elsewhere;
};

/// What gives a name another one: the edits of the text, and places elsewhere that get the name.
struct Renaming {
  std::vector<Edit> edits;
  std::vector<FarPlace> elsewhere;
};

/// A change of the whole text that a user may ask for.
struct Rewrite {
  std::string title;
  std::string kind; ///< of the protocol: `source.renumber`
  std::string text;
};

/// A short text that an editor shows after a place, and what it says of itself.
struct Hint {
  std::uint32_t at = 0;
  std::string label;
  std::string tooltip;
};

struct LanguageShape; // editor/languages/shape.h

/// One language. Every function is pure and takes any text, however broken.
struct LanguageService {
  std::vector<Diagnostic> (*check)(const Source& source, const LanguageOptions& options);
  std::optional<Hover> (*hover)(const Source& source, std::uint32_t offset,
                                const LanguageOptions& options);
  Suggestions (*suggest)(const Source& source, std::uint32_t offset,
                         const LanguageOptions& options);
  std::vector<Symbol> (*outline)(const Source& source);
  /// Everything that is the same name as what stands at `offset`.
  Occurrences (*occurrences)(const Source& source, std::uint32_t offset,
                             const LanguageOptions& options);
  /// What gives the name at `offset` another one, or why that cannot be.
  tl::expected<Renaming, std::string> (*rename)(const Source& source, std::uint32_t offset,
                                                std::string_view name,
                                                const LanguageOptions& options);
  /// The canonical layout; nothing where the text cannot be laid out.
  std::optional<std::string> (*format)(const Source& source);
  /// Only those that change something.
  std::vector<Rewrite> (*rewrites)(const Source& source, const LanguageOptions& options);
  const LanguageShape* shape = nullptr;
  /// In the order of the text; null for a language without any.
  std::vector<Hint> (*hints)(const Source& source, const LanguageOptions& options) = nullptr;
};

/// What a language answers that has no such thing.
namespace nothing {
Occurrences occurrences(const Source& source, std::uint32_t offset, const LanguageOptions& options);
std::optional<std::string> format(const Source& source);
std::vector<Rewrite> rewrites(const Source& source, const LanguageOptions& options);
} // namespace nothing

extern const LanguageService basic_service;
extern const LanguageService structured_service;
extern const LanguageService macro_service;
extern const LanguageService test_service;
extern const LanguageService stimulus_service;

} // namespace orb::editor
