#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
# Stands in for mpirun: drops its options and starts the engine once.
while [ "$1" != none ]; do shift; done
shift
exec "$@"
