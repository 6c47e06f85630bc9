#pragma once

#include "base/rules.h"

/// The rules for courses: `rules::CourseStart`.
namespace orb::report::rules {

#define ORB_RULES "report/rules.def"
#include "base/rules.inc"

} // namespace orb::report::rules
