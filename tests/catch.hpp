// SPDX-License-Identifier: MIT
#pragma once

// Catch2 is version 2 on Debian 12 and version 3 elsewhere; tests include this file and see one library.
// Write `test::Approx`: the versions keep it in different namespaces.

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
