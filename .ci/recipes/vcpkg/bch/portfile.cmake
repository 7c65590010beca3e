# Builds the checkout that this port lies in: vcpkg install bch --overlay-ports=.ci/recipes/vcpkg. The version of xsimd that is tested is
# 8.1.0: an override in the vcpkg.json of whoever installs it asks for that.
get_filename_component(SOURCE_PATH "${CURRENT_PORT_DIR}/../../../.." ABSOLUTE)
set(components ${FEATURES})
list(FILTER components INCLUDE REGEX "^(baked|characters|c)$")
set(tasks threads)
if("tbb" IN_LIST FEATURES)
  set(tasks tbb)
endif()
vcpkg_cmake_configure(
  SOURCE_PATH "${SOURCE_PATH}"
  OPTIONS -DCMAKE_UNITY_BUILD=ON "-DBCH_COMPONENTS=${components}" -DBCH_TASKS=${tasks} -DBCH_BUILD_APPS=OFF -DBCH_BUILD_TESTS=OFF)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(CONFIG_PATH lib/cmake/bch)
file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include" "${CURRENT_PACKAGES_DIR}/debug/share")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
