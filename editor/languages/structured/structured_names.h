#pragma once

// The names of a structured program and their places.

#include "editor/language.h"
#include "structured/compile.h"
#include "structured/meaning/symbols.h"
#include "structured/text/program.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace orb::editor {

inline constexpr std::string_view structured_language_id = "orbstructured";

/// A program with everything it includes.
struct Reading {
  structured::Program program;
  structured::Names names;
  std::vector<std::shared_ptr<const Source>> sources; ///< of its files

  /// The place in its file; nothing if it is outside all files, like a macro's name.
  std::optional<FarPlace> place(Span span) const;
};

Reading read_structured(const Source& source, const LanguageOptions& options);

structured::Compiled compile_structured(const Source& source, const LanguageOptions& options);

/// What a name refers to: a symbol, or a label of a routine.
struct Meaning {
  std::uint32_t symbol = structured::none;
  std::uint32_t routine = structured::none; ///< for a label
  std::uint32_t name = structured::none;    ///< for a label

  friend bool operator==(const Meaning&, const Meaning&) = default;
};

struct NameUse {
  Meaning meaning;
  Span span;
  bool is_set = false;  ///< declared or assigned
  bool defines = false; ///< declared; for an undeclared variable, assigned
};

/// The comment on the line above a declaration, without its mark; may be empty.
std::string comment_above(const Reading& reading, Span declared);

/// All uses of names in a program, by place in the text of all its files.
std::vector<NameUse> name_uses(const Reading& reading);

} // namespace orb::editor
