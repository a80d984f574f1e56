#!/usr/bin/env perl
# Files that are compiled as one (join() of CMakeLists.txt) share no name of a nameless namespace: the compiler refuses
# two functions alike, but of two that differ by their arguments it may take the other file's.
#
# usage: joined_names.pl [ROOT]
use strict;
use warnings;
use File::Basename;
use File::Find;

my $root = shift // dirname(__FILE__) . "/..";
my (%alone, @sources);

for my $folder ('', 'tests/') {
  open my $file, '<', "$root/${folder}CMakeLists.txt" or die "${folder}CMakeLists.txt: $!\n";
  local $/;
  my $text = <$file>;
  while ($text =~ /^\s*compile_alone\(\S+((?:\s+[\w.\/]+)+)\)/mg) {
    $alone{"$folder$_"} = 1 for split ' ', $1;
  }
}
die "no compile_alone() was found\n" unless %alone;
for (sort keys %alone) { die "compile_alone() names $_, which does not exist\n" unless -e "$root/$_"; }

find({ no_chdir => 1, wanted => sub { push @sources, $File::Find::name =~ s/^\Q$root\E\///r if /\.cc$/ } },
  grep { -d } map { "$root/$_" } qw(dem fem coupling apps tests/unit tests/verification));
die "no sources were found\n" unless @sources;

# Which are compiled together: of a folder, by the first letter; of tests/verification, by program.
sub group {
  my ($folder, $name) = (dirname($_[0]), basename($_[0]));
  my $letters = $name =~ /^[a-f]/ ? 'a-f' : $name =~ /^[g-o]/ ? 'g-o' : 'p-z';
  my $program = $folder eq 'tests/verification' && $name =~ /^dem_/ ? ' dem' : '';
  return "$folder$program, $letters";
}

# Functions, variables and types at the outermost level of the nameless namespaces of a file.
sub names_of {
  open my $file, '<', "$root/$_[0]" or die "$_[0]: $!\n";
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

my (%where, $n_names);
for my $source (sort grep { !$alone{$_} } @sources) {
  for my $name (names_of($source)) {
    push @{ $where{ group($source) }{$name} }, $source;
    ++$n_names;
  }
}
my $n_wrong = 0;
for my $group (sort keys %where) {
  for my $name (sort keys %{ $where{$group} }) {
    my @files = @{ $where{$group}{$name} };
    next if @files == 1;
    ++$n_wrong;
    print "$name is in a nameless namespace of @files, which are compiled as one: rename it, or compile_alone() one of them\n";
  }
}
exit 1 if $n_wrong;
print "$n_names names in ", scalar @sources, " files, none twice in what is compiled as one\n";
