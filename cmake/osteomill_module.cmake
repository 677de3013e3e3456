# osteomill_sources(VARIABLE PATTERN FOLDERS... [EXCEPT file...]): sets VARIABLE to the files of these folders, themselves without theirs, that
# the pattern takes. A file that comes or goes is seen by the next build.
function(osteomill_sources variable pattern)
    cmake_parse_arguments(arg "" "" "EXCEPT" ${ARGN})
    set(files)
    foreach(folder ${arg_UNPARSED_ARGUMENTS})
        file(GLOB found CONFIGURE_DEPENDS RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} ${folder}/${pattern})
        list(APPEND files ${found})
    endforeach()
    list(REMOVE_ITEM files "" ${arg_EXCEPT})
    set(${variable} ${files} PARENT_SCOPE)
endfunction()

# osteomill_module(NAME [FOLDERS folder... [EXCEPT file...]] [SOURCES file...] LIBRARIES lib ... [LOOPS]): a static library of all sources in
# these folders, but for those in EXCEPT, and of SOURCES. Includes are written from the repository root ("common/bone/grid.h"). LIBRARIES
# bring their own along, which are not named again.
# LOOPS: it has inner loops that somebody waits for, see osteomill_optimisation.cmake.
function(osteomill_module name)
    cmake_parse_arguments(arg "LOOPS" "" "FOLDERS;EXCEPT;SOURCES;LIBRARIES" ${ARGN})
    osteomill_sources(found *.cpp ${arg_FOLDERS} EXCEPT ${arg_EXCEPT})
    list(APPEND arg_SOURCES ${found})
    if(arg_SOURCES)
        add_library(${name} STATIC ${arg_SOURCES})
        target_include_directories(${name} PUBLIC ${CMAKE_SOURCE_DIR})
        target_link_libraries(${name} PUBLIC ${arg_LIBRARIES} PRIVATE osteomill_warnings)
        if(arg_LOOPS)
            target_compile_options(${name} PRIVATE ${osteomill_loops_options})
        endif()
    else()
        add_library(${name} INTERFACE)
        target_include_directories(${name} INTERFACE ${CMAKE_SOURCE_DIR})
        target_link_libraries(${name} INTERFACE ${arg_LIBRARIES})
    endif()
endfunction()

# osteomill_program(NAME LIBRARIES ...): a program, installed. Its main() is written here and calls NAME_main() of NAME_main.cpp, which is a
# source of one of its libraries: joined with the others, it need not parse all headers again.
function(osteomill_program name)
    cmake_parse_arguments(arg "" "" "LIBRARIES" ${ARGN})
    set(main ${CMAKE_CURRENT_BINARY_DIR}/${name}_calls.cpp)
    file(CONFIGURE OUTPUT ${main} CONTENT
        "int ${name}_main(int, char**);\n\nint main(int argc, char** argv) {\n    return ${name}_main(argc, argv);\n}\n")
    add_executable(${name} ${main})
    target_link_libraries(${name} PRIVATE ${arg_LIBRARIES} osteomill_warnings)
    install(TARGETS ${name} RUNTIME)
endfunction()

# osteomill_embed(VARIABLE TYPE FOLDER ENDING NAMES...): sets VARIABLE to the texts of the files FOLDER/NAME.ENDING as elements of a C++ array,
# TYPE{"NAME", text} each; a change of one of them configures anew.
function(osteomill_embed variable type folder ending)
    set(elements "")
    foreach(name ${ARGN})
        set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${folder}/${name}${ending})
        file(READ ${folder}/${name}${ending} text)
        string(APPEND elements "        ${type}{\"${name}\", R\"text(${text})text\"},\n")
    endforeach()
    set(${variable} "${elements}" PARENT_SCOPE)
endfunction()

# osteomill_vector_loops(MODULE): a module whose inner loops the compiler shall turn into vectors. Square roots without errno and comparisons
# without traps make that possible; no fused multiply-add, so that every instruction set gives the same bits. Vectors are passed only
# to what is inlined, so that how they would be passed (-Wpsabi) does not matter.
function(osteomill_vector_loops module)
    target_compile_options(${module} PRIVATE -fno-math-errno -fno-trapping-math -ffp-contract=off -Wno-psabi)
endfunction()

# osteomill_uses_itk(NAME): it sees the parts of ITK that find_package found last.
function(osteomill_uses_itk name)
    target_include_directories(${name} SYSTEM PRIVATE ${ITK_INCLUDE_DIRS})
    target_link_libraries(${name} PRIVATE ${ITK_LIBRARIES})
    if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
        target_compile_options(${name} PRIVATE "SHELL:-include ${CMAKE_SOURCE_DIR}/cmake/itk_with_clang.h")
    endif()
endfunction()
