# nhsym: symmetries and conservation laws of mechanical systems with constraints.
#
#   make sleigh    install what is missing, build, analyse the Chaplygin sleigh
#   make check     install what the tests need, build, run the tests, of long sweeps a sample (also under ASan and UBSan)
#   make check-all the same with the sweeps in full
#   make           build only            make install PREFIX=/usr/local LIBDIR=.. DESTDIR=..  (make uninstall removes the same files)
#   make library   the shared library    make wheel    the Python package, into build/python
#   make deb       Debian packages, into build/deb (wants debhelper, dh-python and what `make packages` installs)
#   make bench     measure, and write docs/performance.md
#   make catalogue analyse every system without an analysis file, and write docs/catalogue.md
#   make pictures  draw their thumbnails for it
#   make papers    every numbered item of the three papers of the method, and write docs/papers.md
#   make work_precision  draw work against error of every integrator on six systems, and write docs/work_precision.md
#   make reductions reduce every system from STATES=50 initial states, and write docs/reductions.md
#   make random    analyse 200 random systems with built-in symmetries (SYSTEMS=N SEED=N), and print the table
#   make parameters give every system other parameter values, compare its formulas, and write docs/parameters.md (it continues where it was stopped; SEED=N)
#   make absence   is there any other integral, of the systems of the literature, of families and of the catalogue: writes docs/absence.md (minutes)
#   make fields    fit fields in each system, and write docs/fields.md (minutes)
#   make stages    leave out each row of the search over five sets of systems, and write docs/stages.md (an hour; it continues where it was stopped)
#   make perturbed analyse copies of every system with a small term added, and print the table
#   make house     count files, functions and headers, and write the tables of docs/modules.md
#   make site      the documentation as static pages, with a gallery, into build/site (wants pandoc and Python 3)
#   make threads   look for data races with ThreadSanitizer: two contexts of the library, and commands with --threads 4
#   make fuzz      feed the readers with garbage for SECONDS=60 each (needs clang)
#   make help      this list
#   make test-NAME one test program: make test-deck builds and runs tests/test_deck.c
#   make debug     the program for a debugger, without optimisation, into build-debug
#   make coverage  which lines the tests run, as pages in build-coverage/coverage (wants gcovr)
#   make compile_commands.json   how each file is compiled, for editors
#   make format    the sources as .clang-format has them (clang-format 14)
#   make clean

# Compiled once, kept by ccache where it is installed (CCACHE= for without).
CCACHE := $(if $(shell command -v ccache 2>/dev/null),ccache )
CC      = $(CCACHE)gcc
PREFIX  = /usr/local
LIBDIR  = $(PREFIX)/lib
VERSION = 0.2.0
# Of the binary interface nhsym.h: another number when a program that was compiled with the old one would no longer run (docs/changes.md).
SONAME  = libnhsym.so.1
BUILD   = build$(if $(SANITIZE),-$(if $(filter thread,$(SANITIZE)),threads,sanitize))$(KIND:%=-%)
JOBS    = $(shell nproc 2>/dev/null || echo 2)
comma   = ,

# Warnings are errors with the compilers that this was written with; a newer one may warn of what could not be seen yet, and so may a library that deprecates a
# function after us.
KNOWN    = 12 14
WARN    := -Wall -Wextra -Wshadow -Wpointer-arith -Wstrict-prototypes -Wmissing-prototypes -Wvla $(if $(filter $(KNOWN),$(firstword $(subst ., ,$(shell $(CC) -dumpversion)))),-Werror -Wno-error=deprecated-declarations)
# Wrong addresses, which the address sanitizer sees where they are used: these three took a quarter of the time to compile, and an eighth of that to run.
USED     = -fno-sanitize=object-size$(comma)pointer-overflow$(comma)null
SANE     = -fsanitize=$(if $(filter thread,$(SANITIZE)),thread,address$(comma)undefined -fno-sanitize-recover=all $(USED)) -fno-omit-frame-pointer
# -g1: functions and lines, for whoever reads a call stack; -g for a debugger's variables, by CFLAGS=-g.
# KIND: debug, coverage.
OPT      = $(or $(OPT_$(KIND)),$(if $(SANITIZE),-Og -g1 -Wno-maybe-uninitialized $(SANE),-O2 -g1))
OPT_debug    = -O0 -g3 -Wno-maybe-uninitialized
OPT_coverage = -O0 -g1 -Wno-maybe-uninitialized --coverage
# A product and a sum are rounded one after the other, on every machine and in every build.
# CFLAGS, CPPFLAGS and LDFLAGS of the environment and the command line come after the project's own.
# Nothing of the folder where it is built stands in what is built: two builds give the same bytes.
OWN_CFLAGS = -fPIC -fvisibility=hidden -std=c17 -ffp-contract=off -ffile-prefix-map=$(CURDIR)=. $(OPT) $(WARN)
INCLUDES = -Isrc $(patsubst -I%,-isystem %,$(MPI_INCLUDE))
OWN_CPPFLAGS = $(INCLUDES) -D_GNU_SOURCE -DNH_VERSION='"$(VERSION)"' -MMD -MP
COMPILE  = $(CC) $(OWN_CPPFLAGS) $(CPPFLAGS) $(OWN_CFLAGS) $(CFLAGS)
LINK     = $(CC) $(OPT) $(CFLAGS) $(LDFLAGS)
# As this file is read: not with what a target adds.
FLAGS   := $(subst ','\'',$(COMPILE))
# What other versions have in other places: SUNDIALS 7 a core of its own, whose headers want MPI's where it was built with MPI (as Debian's is); FLINT 2
# Arb as a library of its own.
has      = $(if $(findstring /,$(shell $(CC) -print-file-name=lib$(1).so)),-l$(1))
ARB           := $(call has,flint-arb)
SUNDIALS_CORE := $(patsubst -l%,%,$(call has,sundials_core))
MPI_INCLUDE   := $(if $(SUNDIALS_CORE),$(shell pkg-config --cflags-only-I mpi-c 2>/dev/null))
MPI           := $(if $(MPI_INCLUDE),-Wl$(comma)--as-needed $(shell pkg-config --libs mpi-c))
LDLIBS   = $(call libraries,library)
library  = -l$(1)
# The program itself takes archives where there are any (ARCHIVES= for none, or ARCHIVES="gsl openblas" for some): most of a short command was the loading of shared libraries
# (docs/performance.md, "A whole run").  Those that remain come first, for the same reason.  Tests are many, and stay small.
ARCHIVES = yes
archive  = -l$(if $(and $(filter $(if $(filter yes,$(ARCHIVES)),%,$(ARCHIVES)),$(1)),$(findstring /,$(shell $(CC) -print-file-name=lib$(1).a))),:lib$(1).a,$(1))
libraries = -lflint $(ARB) -lgmp -lnlopt -lcjson \
            $(foreach name,sundials_cvode sundials_arkode sundials_ida sundials_nvecserial sundials_sunmatrixdense sundials_sunlinsoldense $(SUNDIALS_CORE) \
                           gsl lapacke openblas yaml expat,$(call $(1),$(name))) \
            $(if $(filter archive,$(1)),$(if $(WITHOUT_MPI),,$(MPI)) $(FORTRAN),$(MPI)) -lm
# No allocation of an archive fails (src/cli/archives.c).
WRAP      = $(addprefix -Wl$(comma)--wrap=,malloc calloc realloc aligned_alloc posix_memalign)
# What OpenBLAS' archive wants.
FORTRAN  = $(if $(findstring :,$(call archive,openblas)),-l:libgfortran.so.5)
# Its stand-in is src/cli/archives.c.
WITHOUT_MPI = $(and $(MPI),$(findstring :,$(call archive,sundials_core)))

PACKAGES      = libgsl-dev libnlopt-dev libsundials-dev libopenblas-dev liblapacke-dev libyaml-dev libexpat1-dev libcjson-dev libflint-arb-dev,libflint-dev libflint-dev libgmp-dev
TEST_PACKAGES = $(PACKAGES) libcriterion-dev pkg-config
BROWSER       = chromium
SITE_PACKAGES = pandoc
PYTHON_PACKAGES = python3-numpy python3-sympy python3-pytest python3-setuptools python3-wheel python3-pandas

MODULES = $(filter-out src/cli/%,$(wildcard src/*/*.c))
OBJECTS = $(MODULES:%.c=$(BUILD)/%.o) $(BUILD)/page.o
# The program; MPI's has another main function.
CLI     = $(patsubst %.c,$(BUILD)/%.o,$(filter-out src/cli/mpi_main.c,$(wildcard src/cli/*.c))) $(BUILD)/fingerprint.o
TESTS   = $(patsubst tests/%.c,$(BUILD)/tests/%,$(wildcard tests/test_*.c))
BENCHES = $(patsubst tests/%.c,$(BUILD)/tests/%,$(wildcard tests/bench_*.c))
# The code of a test needs no sanitizers: those of the library see what it does there, and to compile it twice took a twentieth of `make check`.
# But some ask the compiler for them.
OWN_TESTS := $(shell grep -lE '__SANITIZE_|NH_CHECKED' tests/test_*.c)
SAME      = $(patsubst tests/%.c,build/tests/%.o,$(filter-out $(OWN_TESTS),$(wildcard tests/test_*.c)))

SYSTEMS = 200
STATES  = 50
SEED    = 1
SECONDS = 60

# MPI's program, where MPI is: for scans on many machines. (Open MPI keeps memory to its end, of which a sanitizer would complain.)
HAS_MPI := $(if $(SANITIZE),,$(shell pkg-config --exists mpi-c 2>/dev/null && echo yes))
CLI_MPI  = $(filter-out %/main.o %/archives.o,$(CLI)) $(BUILD)/mpi/mpi_main.o $(BUILD)/mpi/archives.o

.PHONY: all library sleigh check check-all threads tests benches same-tests install uninstall wheel deb deb-source bench catalogue pictures papers work_precision reductions random parameters perturbed stages fields absence classification house site fuzz print-libraries print-includes clean FORCE FORCE-same packages test-packages check-packages check-plain check-sanitized help debug coverage format compile_commands.json
.DELETE_ON_ERROR:
.SECONDARY:

all: $(BUILD)/nhsym $(if $(HAS_MPI),$(BUILD)/nhsym-mpi)

library: $(BUILD)/$(SONAME)

sleigh: packages
	@$(MAKE) --no-print-directory -j$(JOBS) all
	@$(BUILD)/nhsym analyze sleigh

check: check-packages
	@$(MAKE) --no-print-directory -j$(JOBS) check-plain check-sanitized
	@$(MAKE) --no-print-directory -j$(JOBS) SANITIZE=1 tests
	@sh tests/run.sh build build-sanitize

# Together: while one links the program, the other compiles.
check-plain:
	@$(MAKE) --no-print-directory all tests
check-sanitized:
	@$(MAKE) --no-print-directory SANITIZE=1 all

check-all: export NHSYM_SWEEPS = all
check-all: check

# OpenBLAS' own threads are not compiled for this.
threads: test-packages
	@$(MAKE) --no-print-directory -j$(JOBS) SANITIZE=thread all build-threads/tests/bench_contexts
	@OPENBLAS_NUM_THREADS=1 sh tests/threads.sh build-threads

tests: $(TESTS) $(if $(SANITIZE),,library $(if $(NHSYM_SWEEPS),benches))

# Measurements are built where they run, and with the long sweeps; not under sanitizers.
benches: $(BENCHES) library

same-tests: $(SAME)

# ---- for whoever works on the sources ----

help:
	@sed -n 's/^#   make/  make/p' Makefile

test-%: $(BUILD)/tests/test_%
	@$<

debug:
	@$(MAKE) --no-print-directory KIND=debug all

# A test that runs the program takes that of this build.
coverage: test-packages
	@sh tests/packages.sh gcovr
	@$(MAKE) --no-print-directory -j$(JOBS) KIND=coverage all library tests
	@sh tests/run.sh build-coverage || :
	@mkdir -p build-coverage/coverage
	@gcovr -j $(JOBS) -r . -f src/ build-coverage --html-details build-coverage/coverage/index.html --print-summary

compile_commands.json:
	@for file in $(wildcard src/*/*.c tests/*.c); do \
	    printf '%s{"directory": "%s", "file": "%s", "command": "%s -c %s"}' "$${next-[}" '$(CURDIR)' "$$file" '$(subst ','\'',$(subst ",\",$(COMPILE)))' "$$file"; \
	    next=','; done >$@ && echo ']' >>$@

FORMATTER = clang-format-14
format:
	@$(FORMATTER) -i $(wildcard src/*.h src/*/*.[ch])

bench: test-packages
	@$(MAKE) --no-print-directory -j$(JOBS) all benches $(BUILD)/tests/nhsym-shared
	@sh tests/bench.sh $(BUILD) docs/performance.md
	@$(MAKE) --no-print-directory work_precision

# A page of docs/: what tests/pages says of it, and what a program prints.
page = @{ cat tests/pages/$@.md && $(1); } >$(BUILD)/$@.md; code=$$?; mv $(BUILD)/$@.md docs/

catalogue: test-packages
	@$(MAKE) --no-print-directory -j$(JOBS) benches
	$(call page,$(BUILD)/tests/bench_catalogue systems); $(MAKE) --no-print-directory pictures || code=1; tail -n 1 docs/$@.md; exit $$code

pictures: test-packages
	@$(MAKE) --no-print-directory -j$(JOBS) benches
	@$(BUILD)/tests/bench_pictures systems docs/catalogue

classification: test-packages
	@$(MAKE) --no-print-directory -j$(JOBS) benches
	$(call page,$(BUILD)/tests/bench_classify); sed '/^|/s/\*/\\*/g' docs/$@.md >$(BUILD)/$@.md && mv $(BUILD)/$@.md docs/; tail -n 1 docs/$@.md; exit $$code

# Results are of this library, and of no other.
stages: test-packages
	@$(MAKE) --no-print-directory -j$(JOBS) benches
	@mkdir -p $(BUILD)/stages
	$(call page,$(BUILD)/tests/bench_stages $(BUILD)/stages/$$(sha256sum <$(BUILD)/libnhsym.a | cut -c1-12) all); exit $$code

fields: test-packages
	@$(MAKE) --no-print-directory -j$(JOBS) benches
	$(call page,$(BUILD)/tests/bench_fields systems); tail -n 1 docs/$@.md; exit $$code

absence: test-packages
	@$(MAKE) --no-print-directory -j$(JOBS) benches
	$(call page,$(BUILD)/tests/bench_absence systems); tail -n 1 docs/$@.md; exit $$code

papers: test-packages
	@$(MAKE) --no-print-directory -j$(JOBS) all benches
	$(call page,$(BUILD)/tests/bench_papers); tail -n 1 docs/$@.md; exit $$code

work_precision: test-packages
	@$(MAKE) --no-print-directory -j$(JOBS) $(BUILD)/tests/bench_work_precision
	$(call page,$(BUILD)/tests/bench_work_precision systems docs/pictures); exit $$code

reductions: test-packages
	@$(MAKE) --no-print-directory -j$(JOBS) benches
	$(call page,$(BUILD)/tests/bench_reductions systems $(STATES)); tail -n 1 docs/$@.md; exit $$code

# One row per system, made anew when the program or the system is newer.
ROWS = $(BUILD)/parameters-$(SEED)
PARAMETER_ROWS = $(patsubst systems/%.yaml,$(ROWS)/%.row,$(wildcard systems/*.yaml))
$(ROWS)/%.row: systems/%.yaml $(BUILD)/tests/bench_parameters
	@mkdir -p $(@D)
	@$(BUILD)/tests/bench_parameters $< $(SEED) >$@

parameters: test-packages
	@$(MAKE) --no-print-directory -j$(JOBS) benches
	@$(MAKE) --no-print-directory -k -j$(JOBS) $(PARAMETER_ROWS); code=$$?; sh tests/parameters.sh $(ROWS) >$(BUILD)/parameters.md && mv $(BUILD)/parameters.md docs/ || code=1; tail -n 1 docs/parameters.md; exit $$code

random perturbed: test-packages
	@$(MAKE) --no-print-directory -j$(JOBS) benches
	@$(BUILD)/tests/bench_$@ $(if $(filter random,$@),$(SYSTEMS),systems) $(SEED)

# Between its two marks in the page.
house: all
	@sh tests/house.sh $(BUILD) >$(BUILD)/house.md
	@sed -e '/<!-- house -->/r $(BUILD)/house.md' -e '/<!-- house -->/,/<!-- end -->/{/<!--/!d}' docs/modules.md >$(BUILD)/modules.md && mv $(BUILD)/modules.md docs/modules.md

# The gallery shows these; everything else about them is the program's.
GALLERY = sleigh euler_disk crane lagrange_top rolling_disk snakeboard rattleback chaplygin_ball double_pendulum kepler toda_lattice roller_racer
site: all
	@command -v pandoc >/dev/null || sh tests/packages.sh $(SITE_PACKAGES)
	@python3 docs/site/make.py $(BUILD)/site $(BUILD)/nhsym $(GALLERY)

fuzz:
	@sh tests/packages.sh $(PACKAGES) clang
	@sh tests/fuzz/fuzz.sh $(SECONDS)

print-libraries:
	@echo $(LDLIBS)

print-includes:
	@echo $(INCLUDES)

packages:
	@sh tests/packages.sh $(PACKAGES)

test-packages:
	@sh tests/packages.sh $(TEST_PACKAGES)

# A system without these packages (another than Debian's chromium, or Python) gets its tests all the same, those in the browser or of Python skipped.
check-packages: test-packages
	@sh tests/python.sh -c pass 2>/dev/null || sh tests/packages.sh $(PYTHON_PACKAGES) || echo "without these packages the tests of the Python package are skipped"
	@command -v chromium >/dev/null || sh tests/packages.sh $(BROWSER) || echo "without a browser the tests in it are skipped"

$(BUILD)/libnhsym.a: $(OBJECTS)
	@rm -f $@ && ar rcs $@ $(OBJECTS)

$(BUILD)/nhsym: $(CLI) $(BUILD)/libnhsym.a
	@echo "  link $@"
	@$(LINK) $(WRAP) $(CLI) $(BUILD)/libnhsym.a $(call libraries,archive) -o $@

# Only what nhsym.h marks NH_API is seen from outside, and has a version.  (-fvisibility=hidden alone forgets functions that have clones for several processors.)
$(BUILD)/libnhsym.map: src/nhsym.h
	@mkdir -p $(@D)
	@{ echo 'NHSYM_$(subst libnhsym.so.,,$(SONAME)) { global:'; sed -n 's/^NH_API .*[ *]\(nh_[a-z_]*\)(.*/    \1;/p' $<; echo '  local: *; };'; } >$@

$(BUILD)/$(SONAME): $(OBJECTS) $(BUILD)/libnhsym.map
	@echo "  link $@"
	@$(LINK) -shared -Wl,-soname,$(SONAME) -Wl,-z,defs -Wl,--version-script=$(BUILD)/libnhsym.map $(OBJECTS) $(LDLIBS) -o $@

$(BUILD)/nhsym-mpi: $(CLI_MPI) $(BUILD)/libnhsym.a
	@echo "  link $@"
	@$(LINK) $(WRAP) $(CLI_MPI) $(BUILD)/libnhsym.a $(call libraries,archive) $$(pkg-config --libs mpi-c) -o $@

$(BUILD)/mpi/%.o: src/cli/%.c $(BUILD)/flags
	@mkdir -p $(@D)
	@echo "  cc   $<"
	@$(COMPILE) $(patsubst -I%,-isystem %,$(shell pkg-config --cflags-only-I mpi-c)) -c $< -o $@

# By which a scan knows the program that began it.
$(BUILD)/fingerprint.o: $(BUILD)/libnhsym.a
	@printf 'extern const char nh_cli_fingerprint[]; const char nh_cli_fingerprint[] = "%s";\n' "$$(sha256sum <$< | cut -c1-16)" | $(CC) $(CFLAGS) -xc -c - -o $@

# For `make bench`: what the archives are good for.
$(BUILD)/tests/nhsym-shared: $(CLI) $(BUILD)/libnhsym.a
	@mkdir -p $(@D)
	@$(LINK) $(WRAP) $(CLI) $(BUILD)/libnhsym.a $(LDLIBS) -o $@

$(BUILD)/src/cli/archives.o: OWN_CPPFLAGS += $(if $(WITHOUT_MPI),-DNH_WITHOUT_MPI)

# The loops over batches of points; see the head of the file for why no -ffast-math.
$(BUILD)/src/evaluate/tape_batch.o: OWN_CFLAGS += -O3 -fno-math-errno -fno-trapping-math

$(BUILD)/src/motion/ensemble.o: OWN_CFLAGS += -O3

# The loops over residues.
$(BUILD)/src/exact/residue.o $(BUILD)/src/exact/row_sum.o $(BUILD)/src/exact/gather_sum.o \
$(BUILD)/src/exact/gather_shape.o: OWN_CFLAGS += -O3

# Where systems are looked for at last (src/problem/places.c).
$(BUILD)/src/problem/places.o: OWN_CPPFLAGS += -DNH_DATADIR='"$(PREFIX)/share/nhsym"'

# Objects that were compiled in another way are compiled again.
$(BUILD)/flags: FORCE
	@mkdir -p $(@D)
	@echo '$(FLAGS)' | cmp -s - $@ || echo '$(FLAGS)' >$@
FORCE:

# What a page carries with it: style, scripts, font.
$(BUILD)/page.c: $(wildcard src/document/page/*)
	@mkdir -p $(@D)
	@sh src/document/page/embed.sh src/document/page >$@
$(BUILD)/page.o: $(BUILD)/page.c $(BUILD)/flags
	@$(COMPILE) -c $< -o $@

$(BUILD)/%.o: %.c $(BUILD)/flags
	@mkdir -p $(@D)
	@echo "  cc   $<"
	@$(COMPILE) -c $< -o $@

# The code of a test itself takes no time worth optimising, and four times as long to compile; of its arithmetic nobody wants to know.  A bench times the library, not itself.
$(BUILD)/tests/test_%.o: OWN_CFLAGS += -O0 -g0
$(BUILD)/tests/bench_%.o: OWN_CFLAGS += -O1 -g0
# Tests are linked, and linked anew, a hundred at a time; each test is a process, which loads what its program needs and no more.
FAST_LINKER := $(if $(shell command -v ld.gold 2>/dev/null),-fuse-ld=gold)

# They take what is installed, and Python's package, from the build.
$(if $(SANITIZE),,$(BUILD)/tests/test_docs $(BUILD)/tests/test_install $(BUILD)/tests/test_python: | $(BUILD)/$(SONAME))

link_test = @echo "  link $@"; $(LINK) $(FAST_LINKER) $< $(BUILD)/tests/criterion_start.o $(BUILD)/libnhsym.a -Wl,--as-needed $(LDLIBS) -lcriterion -o $@

$(BUILD)/tests/%: $(BUILD)/tests/%.o $(BUILD)/tests/criterion_start.o $(BUILD)/libnhsym.a
	$(link_test)

ifneq ($(SANITIZE),)
$(patsubst build/%.o,$(BUILD)/%,$(SAME)): $(BUILD)/tests/%: build/tests/%.o $(BUILD)/tests/criterion_start.o $(BUILD)/libnhsym.a
	$(link_test)

$(SAME): FORCE-same
	@:
FORCE-same:
	@$(MAKE) --no-print-directory SANITIZE= same-tests
endif

# Built from a copy, as setuptools leaves files beside its sources; like `pip install src/python`, with the library inside.
wheel: library
	@rm -rf $(BUILD)/python && mkdir -p $(BUILD)/python && cp -r src/python $(BUILD)/python/source && rm -rf $(BUILD)/python/source/build && ln -s $(CURDIR) $(BUILD)/python/source/sources && \
	python=$(CURDIR)/tests/python.sh && cd $(BUILD)/python/source && \
	sh "$$python" -c 'from setuptools import build_meta as b; b.build_sdist(".."); b.build_wheel("..")' >../log 2>&1 || { cat ../log; exit 1; }
	@ls $(BUILD)/python/nhsym*

# Debian packages, from a copy whose folder debian is src/debian; into $(BUILD)/deb.
# Without the page tests: their axe.min.js is no source, and no package runs them.
DEB = $(BUILD)/deb/nhsym-$(VERSION)
deb-source:
	@rm -rf $(BUILD)/deb && mkdir -p $(DEB)
	@tar -cf - --exclude='./build*' --exclude=./.git --exclude=./tests/browser . | tar -xf - -C $(DEB)
	@mv $(DEB)/src/debian $(DEB)/debian
	@sed -e 's/@VERSION@/$(VERSION)/' -e "s/@DATE@/$$(LC_ALL=C date -R -u $$([ "$$SOURCE_DATE_EPOCH" ] && echo "-d@$$SOURCE_DATE_EPOCH" || echo "-r docs/changes.md"))/" $(DEB)/debian/changelog.in >$(DEB)/debian/changelog && rm $(DEB)/debian/changelog.in

deb: deb-source
	cd $(DEB) && dpkg-buildpackage -us -uc
	@ls $(BUILD)/deb/*.deb

# ---- installation ----

SHARE = $(DESTDIR)$(PREFIX)/share

install: all library
	install -d $(DESTDIR)$(PREFIX)/bin $(DESTDIR)$(PREFIX)/include $(DESTDIR)$(LIBDIR)/pkgconfig
	install -m 755 $(BUILD)/nhsym $(if $(HAS_MPI),$(BUILD)/nhsym-mpi) $(DESTDIR)$(PREFIX)/bin/
	install -m 644 src/nhsym.h $(DESTDIR)$(PREFIX)/include/
	install -m 644 $(BUILD)/$(SONAME) $(DESTDIR)$(LIBDIR)/$(SONAME).$(VERSION)
	ln -sf $(SONAME).$(VERSION) $(DESTDIR)$(LIBDIR)/$(SONAME)
	ln -sf $(SONAME) $(DESTDIR)$(LIBDIR)/libnhsym.so
	install -m 644 $(BUILD)/libnhsym.a $(DESTDIR)$(LIBDIR)/
	sed -e 's|@PREFIX@|$(PREFIX)|' -e 's|@LIBDIR@|$(LIBDIR:$(PREFIX)/%=$${prefix}/%)|' -e 's|@VERSION@|$(VERSION)|' -e 's|@LIBRARIES@|$(LDLIBS)|' src/library/nhsym.pc.in \
	    >$(DESTDIR)$(LIBDIR)/pkgconfig/nhsym.pc
	install -d $(addprefix $(SHARE)/nhsym/,systems/stress analyses schema) $(addprefix $(SHARE)/doc/nhsym/,pictures catalogue extend notebooks)
	install -m 644 systems/*.yaml $(SHARE)/nhsym/systems/
	install -m 644 systems/stress/*.yaml $(SHARE)/nhsym/systems/stress/
	install -m 644 analyses/*.yaml $(SHARE)/nhsym/analyses/
	install -m 644 docs/schema/*.json $(SHARE)/nhsym/schema/
	for page in README.md docs/*.md; do \
	    sed 's#](docs/#](#g; s#](schema/#](../../nhsym/schema/#g; s#](LICENSE)#](https://www.gnu.org/licenses/gpl-3.0.html)#; s#](\.\./tests/extend/#](extend/#g' $$page >$(SHARE)/doc/nhsym/$${page##*/} || exit; done # with the links that hold there
	install -m 644 docs/example.c docs/nhsym.ipynb docs/CITATION.cff $(SHARE)/doc/nhsym/
	install -m 644 docs/pictures/* $(SHARE)/doc/nhsym/pictures/
	install -m 644 docs/notebooks/* $(SHARE)/doc/nhsym/notebooks/
	install -m 644 docs/catalogue/* $(SHARE)/doc/nhsym/catalogue/
	install -m 644 tests/extend/*.txt $(SHARE)/doc/nhsym/extend/
	install -d $(addprefix $(SHARE)/,man/man1 man/man3 bash-completion/completions zsh/site-functions fish/vendor_completions.d)
	$(BUILD)/nhsym help man >$(SHARE)/man/man1/nhsym.1
	awk -v version=$(VERSION) -f src/library/man.awk src/nhsym.h >$(SHARE)/man/man3/nhsym.3
	$(BUILD)/nhsym help bash >$(SHARE)/bash-completion/completions/nhsym
	$(BUILD)/nhsym help zsh >$(SHARE)/zsh/site-functions/_nhsym
	$(BUILD)/nhsym help fish >$(SHARE)/fish/vendor_completions.d/nhsym.fish

# What `make install` would put there, and the folders that are then empty: the project's own, and below a DESTDIR all.
uninstall: all library
	@stage=$$(mktemp -d) && trap 'rm -rf "$$stage"' EXIT && $(MAKE) -s --no-print-directory install DESTDIR="$$stage" && cd "$$stage" && \
	find . ! -type d | while read -r file; do rm -f "$(DESTDIR)/$$file"; done && \
	find . -mindepth 1 -depth -type d $(if $(DESTDIR),,-path '*/nhsym*') | while read -r folder; do rmdir "$(DESTDIR)/$$folder" 2>/dev/null || :; done

clean:
	rm -rf build build-sanitize build-threads build-fuzz build-debug build-coverage

-include $(OBJECTS:.o=.d) $(CLI:.o=.d) $(TESTS:=.d) $(BENCHES:=.d)
