#!/usr/bin/env perl
# Files that are compiled as one (join() of CMakeLists.txt) share no name of a nameless namespace: the compiler refuses
# two functions alike, but of two that differ by their arguments it may take the other file's.
#
# usage: joined_names.pl BUILD...     folders whose */Unity/*.cxx, written by CMake, say what is joined
use strict;
use warnings;
use File::Find;

die "usage: joined_names.pl BUILD...\n" unless @ARGV;

# Functions, variables and types at the outermost level of the nameless namespaces of a file.
sub names_of {
  open my $file, '<', $_[0] or die "$_[0]: $!\n";
  local $/;
  my $text = <$file>;
  my %names;
  while ($text =~ /^namespace \{\n(.*?)^\} \/\/ namespace$/msg) {
    my $inside = $1;
    while ($inside =~ /^(?![\s\/}#]|using |template)(?:\[\[[^\]]*\]\] ?)*([^\n;={(]*?)(\w+)(?:\(|\[| =|\{|;|$| \{)/mg) {
      $names{$2} = 1 unless $2 =~ /^(?:const|constexpr|inline|static|struct|class|enum)$/;
    }
  }
  return sort keys %names;
}

my @units;
find({ no_chdir => 1, wanted => sub { push @units, $File::Find::name if /\/Unity\/[^\/]*\.cxx$/ } }, @ARGV);
my ($n_files, $n_names, $n_wrong) = (0, 0, 0);
for my $unit (sort @units) {
  open my $file, '<', $unit or die "$unit: $!\n";
  my %where;
  for my $source (map { /^#include "(.*)"/ ? $1 : () } <$file>) {
    ++$n_files;
    for my $name (names_of($source)) {
      ++$n_names;
      push @{ $where{$name} }, $source;
    }
  }
  for my $name (sort grep { @{ $where{$_} } > 1 } keys %where) {
    ++$n_wrong;
    print "$name is in a nameless namespace of @{ $where{$name} }, which are compiled as one: rename it, or compile_alone() one of them\n";
  }
}
exit 1 if $n_wrong;
print "$n_names names in $n_files files, none twice in the ", scalar @units, " units of several files\n";
