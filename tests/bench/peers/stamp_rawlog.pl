#!/usr/bin/perl
# usage: zcat -f IN.rawlog | stamp_rawlog.pl LOG > OUT.rawlog
# Debian's carmen2rawlog stamps every record with the time of the conversion, and icp-slam drops odometry that is not
# newer than what it has. Gives the two records of each FLASER line (odometry, scan) the stamp of the line.
use strict;
use warnings;

my ($log) = @ARGV or die "usage: stamp_rawlog.pl LOG < IN > OUT\n";
open(my $lines, '<', $log) or die "$log: $!\n";
my @stamps = map { (split)[-3] } grep { /^FLASER/ } <$lines>;

binmode STDIN;
binmode STDOUT;
local $/;
my $rawlog = <STDIN>;
my ($same) = $rawlog =~ /\x08\x00\x00\x00ODOMETRY(.{8})/s or die "no odometry record in the rawlog\n";
my $records = () = $rawlog =~ /\Q$same\E/g;
$records == 2 * @stamps or die "$records records for " . scalar(@stamps) . " lines: another kind of log or of MRPT\n";

# MRPT counts steps of 100 ns since 1601. A scan is 1 ms newer than its odometry.
my $record = 0;
$rawlog =~ s{\Q$same\E}{
  my $stamp_s = $stamps[int($record / 2)] + ($record % 2 ? 0.001 : 0.0);
  ++$record;
  pack('Q<', int(($stamp_s + 11644473600) * 1e6) * 10);
}ge;
print $rawlog;
