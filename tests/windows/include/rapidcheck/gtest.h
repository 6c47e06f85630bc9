#pragma once

#include <rapidcheck.h>
