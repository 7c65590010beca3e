/* SPDX-License-Identifier: MIT
 * Copyright (c) 2026 the bch authors */

/* Loads the library while the program runs, as engines load plugins. Usage: plugin LIBRARY */
#include <stdio.h>
#include <string.h>

#include <bch/bch.h>

#if defined(_WIN32)
#include <windows.h>
typedef HMODULE Library;
typedef FARPROC Address;
static Library open_library(const char* path) {
  return LoadLibraryA(path);
}
static Address address_of(Library library, const char* name) {
  return GetProcAddress(library, name);
}
static int close_library(Library library) {
  return FreeLibrary(library) != 0;
}
static int is_loaded(const char* path) {
  return GetModuleHandleA(path) != NULL;
}
#else
#include <dlfcn.h>
typedef void* Library;
typedef void* Address;
static Library open_library(const char* path) {
  return dlopen(path, RTLD_NOW | RTLD_LOCAL);
}
static Address address_of(Library library, const char* name) {
  return dlsym(library, name);
}
static int close_library(Library library) {
  return dlclose(library) == 0;
}
static int is_loaded(const char* path) {
  return dlopen(path, RTLD_LAZY | RTLD_NOLOAD) != NULL;
}
#endif

/* ISO C has no cast from the pointers that dlsym() returns to those of functions. */
static void find(Library library, const char* name, void* function) {
  const Address found = address_of(library, name);
  if (found == NULL) fprintf(stderr, "no function %s\n", name);
  memcpy(function, &found, sizeof found);
}

int main(int argc, char** argv) {
  const Library library = argc == 2 ? open_library(argv[1]) : NULL;
  if (library == NULL) {
    fprintf(stderr, "%s\n", argc == 2 ? "no such library" : "usage: plugin LIBRARY");
    return 1;
  }
  uint32_t (*abi_version)(void) = NULL;
  bch_status (*create)(const bch_plan*, bch_shape_set_builder**) = NULL;
  bch_status (*add_cylinder)(bch_shape_set_builder*, float, const bch_heights*) = NULL;
  bch_status (*finish)(bch_shape_set_builder*, bch_shape_set**) = NULL;
  bch_status (*collide)(const bch_shape_set*, const bch_agents*, const bch_pair*, size_t, const bch_query_options*,
                        uint8_t*) = NULL;
  bch_status (*free_set)(bch_shape_set*) = NULL;
  bch_status (*free_builder)(bch_shape_set_builder*) = NULL;
  find(library, "bch_abi_version", &abi_version);
  find(library, "bch_shape_set_builder_create", &create);
  find(library, "bch_shape_set_builder_add_cylinder", &add_cylinder);
  find(library, "bch_shape_set_builder_finish", &finish);
  find(library, "bch_collide", &collide);
  find(library, "bch_shape_set_free", &free_set);
  find(library, "bch_shape_set_builder_free", &free_builder);
  if (abi_version == NULL || abi_version() != BCH_ABI_VERSION) {
    fprintf(stderr, "a library of another interface\n");
    return 1;
  }

  bch_shape_set_builder* builder = NULL;
  bch_shape_set* set = NULL;
  int fine = create(NULL, &builder) == BCH_OK && add_cylinder(builder, 0.25f, NULL) == BCH_OK &&
             finish(builder, &set) == BCH_OK;

  const uint32_t shape[] = {0, 0, 0};
  const double x[] = {0, 0.4, 2}, y[] = {0, 0, 0}, heading[] = {0, 0, 0};
  const bch_pair pairs[] = {{0, 1}, {1, 2}};
  uint8_t hits[2] = {9, 9};
  bch_agents agents = BCH_AGENTS_INIT;
  agents.shape = shape, agents.x = x, agents.y = y, agents.heading = heading, agents.count = 3;
  fine = fine && collide(set, &agents, pairs, 2, NULL, hits) == BCH_OK && hits[0] == 1 && hits[1] == 0;

  fine = free_set(set) == BCH_OK && free_builder(builder) == BCH_OK && fine;
  /* It stays when it is closed: threads may still wait in it. */
  fine = close_library(library) && is_loaded(argv[1]) && fine;
  printf("%s\n", fine ? "one pair of two collides" : "wrong");
  return fine ? 0 : 1;
}
