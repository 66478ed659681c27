# An overlay port of vcpkg: the library from this clone, for projects that take what they need from vcpkg. In such a project
#
#     vcpkg.json                  { "dependencies": ["halflight"] }
#     vcpkg-configuration.json    { "overlay-ports": ["path/to/halflight/examples/vcpkg"] }
#     CMakeLists.txt              find_package(halflight 0.1 REQUIRED), halflight::halflight
#
# or, without a manifest, `vcpkg install halflight --overlay-ports=path/to/halflight/examples/vcpkg`.
set(SOURCE_PATH "${CMAKE_CURRENT_LIST_DIR}/../../..")
vcpkg_cmake_configure(
  SOURCE_PATH "${SOURCE_PATH}"
  OPTIONS -DHALFLIGHT_APP=OFF -DHALFLIGHT_C=OFF -DHALFLIGHT_TESTS=OFF -DHALFLIGHT_INSTALL=ON
)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(CONFIG_PATH lib/cmake/halflight)
vcpkg_fixup_pkgconfig()
file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
