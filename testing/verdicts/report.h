#pragma once

#include "testing/results.h"
#include "testing/suite.h"
#include "testing/verdicts/render.h"

#include <map>
#include <string>
#include <string_view>

namespace orb::testing {

/// Receives the files of a report.
class Pages {
public:
  virtual ~Pages() = default;
  /// Writes a file; `name` is relative to the report's folder. False ends the report.
  virtual bool write(const std::string& name, std::string_view text) = 0;
};

/// The first text of a report's index, by which orb recognises one.
extern const std::string_view report_mark;

/// Writes a picture of each run, a replay of each failure, and last the page that shows them all:
/// `index.html`. If there are very many runs, only the first ones and the failures get pictures.
/// Runs that are shown are run again. If several programs were tested, each gets a page to hand
/// back, in `pupils/`, headed by its name in `names`; `certificates.html` is for those that passed.
bool write_report(const Suite& suite, const Results& results, Pages& pages,
                  const std::map<std::string, std::string>& names = {}, const Speech& speech = {});

} // namespace orb::testing
