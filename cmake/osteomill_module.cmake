# osteomill_module(NAME SOURCES a.cpp ... LIBRARIES lib ...): one static library per folder of the house.
# Includes are written from the repository root ("common/bone/grid.h").
function(osteomill_module name)
    cmake_parse_arguments(arg "" "" "SOURCES;LIBRARIES" ${ARGN})
    if(arg_SOURCES)
        add_library(${name} STATIC ${arg_SOURCES})
        target_include_directories(${name} PUBLIC ${CMAKE_SOURCE_DIR})
        target_link_libraries(${name} PUBLIC ${arg_LIBRARIES} PRIVATE osteomill_warnings)
        target_precompile_headers(${name} REUSE_FROM osteomill_precompiled)
    else()
        add_library(${name} INTERFACE)
        target_include_directories(${name} INTERFACE ${CMAKE_SOURCE_DIR})
        target_link_libraries(${name} INTERFACE ${arg_LIBRARIES})
    endif()
endfunction()

# osteomill_program(NAME SOURCES ... LIBRARIES ...): a thin main over the modules; installed.
function(osteomill_program name)
    cmake_parse_arguments(arg "" "" "SOURCES;LIBRARIES" ${ARGN})
    add_executable(${name} ${arg_SOURCES})
    target_link_libraries(${name} PRIVATE ${arg_LIBRARIES} osteomill_warnings)
    target_compile_definitions(${name} PRIVATE OSTEOMILL_VERSION="${PROJECT_VERSION}")
    install(TARGETS ${name} RUNTIME)
endfunction()
