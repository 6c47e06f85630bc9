#pragma once

#include "base/diagnostic.h"
#include "base/style.h"

#include <functional>
#include <string>

namespace orb {

/// Renders a message in the reader's language (base/catalogue.h).
using Say = std::function<std::string(const Message&)>;

/// The word for a severity, and the role that gives its colour.
Message severity_word(Severity severity);
Role role_of(Severity severity);

/// The finding in one line: problem, then help.
std::string in_one_line(const Diagnostic& diagnostic);

/// Renders a finding for a terminal: a gcc-style line, the excerpt with a caret, help and notes.
std::string render_text(const Source& source, const Diagnostic& diagnostic, Style style,
                        const Say& say = &in_english);

/// Renders a finding as compilers do, with each note on its own line: `F:L:C: error: text [rule]`.
std::string render_gcc(const Source& source, const Diagnostic& diagnostic);

/// Renders the closing line of the text form: `2 errors, 1 warning in 3 files`.
std::string render_summary(const std::vector<FileFindings>& files, const Say& say = &in_english);

/// Renders all findings as one JSON document with schema `orb.check/1`
/// (docs/reference/findings.md).
std::string render_json(const std::vector<FileFindings>& files, const Say& say = &in_english);

/// Returns the address that explains a rule; may be empty.
using HelpUri = std::function<std::string(const Rule&)>;

/// Renders all findings as one SARIF 2.1.0 log. Columns count code points; bytes that are not UTF-8
/// become U+FFFD. A finding keeps its fingerprint when lines above it come and go.
std::string render_sarif(const std::vector<FileFindings>& files, const HelpUri& help_uri = {});

} // namespace orb
