// SPDX-License-Identifier: MIT
#pragma once

// Catch2 is version 2 on Debian 12 and version 3 elsewhere; tests include this file and see one library.
// Write `test::Approx`: the versions keep it in different namespaces. Write `SKIP_TEST(reason)`: version 2 has no SKIP.

#if __has_include(<catch2/catch_all.hpp>)
#include <catch2/catch_all.hpp>
namespace test {
using Catch::Approx;
}
#else
#include <catch2/catch.hpp>
namespace test {
using Catch::Detail::Approx;
}
#endif

// Ends a test that cannot run on this machine; the first statement of a test. ctest looks for these words and reports the test as skipped
// (SKIP_REGULAR_EXPRESSION in tests/CMakeLists.txt).
#define SKIP_TEST(reason)                                    \
  do {                                                       \
    WARN("this test cannot run and is skipped: " << reason); \
    return;                                                  \
  } while (false)
