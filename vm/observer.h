#pragma once

// The path under which the installed library has always offered the events.
#include "vm/common/observer.h"
