#!/usr/bin/env perl
# The field's words: what code, messages and pages do not say, and what they say instead. CONTRIBUTING.md, Words.
#
# Whole words, capitals ignored. Names are read part by part: n_legs and DrivenPair are "n legs" and "driven
# pair". Names on disk (in quotes, with a low line: "grain_loads") belong to the format of a file and are left out.
#
# usage: tests/words.pl [FOLDER]     prints file:line: "word": use "other", and ends with 1 where it finds one
use strict;
use warnings;
use File::Basename qw(dirname);
use Cwd qw(abs_path);

my $root = shift // dirname(abs_path($0)) . '/..';
chdir $root or die "words.pl: $root: $!\n";

# What is not said, as a pattern of whole words => what is said.
my @words = (
  [qr/legs?/ => 'loading stage'],
  [qr/goals?/ => 'target'],
  [qr/(?<!of )courses?/ => 'loading stage'],
  [qr/ledgers?/ => 'energy balance'],
  [qr/books?|booked/ => 'energy balance'],
  [qr/residues?/ => 'energy released at bond breakage'],
  [qr/skew|skewed/ => 'antisymmetric'],
  [qr/jacks?|jacked|jacking/ => 'penetration rate'],
  [qr/keepers?/ => 'checkpoint scheduler'],
  [qr/lips?/ => 'collar'],
  [qr/foreign/ => 'remote'],
  [qr/meetings?/ => 'contact geometry'],
  [qr/bod(?:y|ies)(?! of revolution)/ => 'particle', qr/rigid[ -]*bod(?:y|ies)/],
  [qr/living (?:bonds?)/ => 'intact bond'],
  [qr/shar(?:e|es|ed|ing) out/ => 'distribute'],
  [qr/(?:take|takes|taken|took|taking) up(?! to)/ => 'resume'],
  [qr/driven (?:cells?|axis|axes|strains?|stress|pairs?|assembl(?:y|ies)|rocks?)/ => 'strain-controlled'],
  [qr/held spins?|locked spins?|rotation locks?/ => 'rotation constraint'],
  [qr/greatest/ => 'largest, global max'],
  [qr/(?<!at )(?<!at the )least(?!.squares)/ => 'smallest, global min'],
  [qr/goes bad|the book closes/ => 'a plain verb'],
  [qr/grain (?:by grain|pairs?|bonds?|stress(?:es)?|states?|contacts?|loads?)/ => 'particle'],
  [qr/designs? (?:section|§|page|\d)|design\.md/ => 'a page of this repository'],
);

# Code of dem/ and coupling/ moves particles: rock is a material, and a word of comments and messages.
my @words_of_code = (
  [qr/rocks?/ => 'assembly'],
  [qr/grains?/ => 'particle'],
  [qr/spheres?/ => 'particle', qr/sphere (?:mass|volume)|bounding sphere|ball/],
);

# Where a word is the thing itself.
my %allowed = (
  'tests/words.pl' => qr/./,
  'CHANGELOG.md' => qr/./,         # tells the old names
  'tests/gates/plant.sh' => qr/planted/,
  'tests/program/bad_input.sh' => qr/^(?:pile|element|bond)\|/, # former keys
  'apps/view/options.cc' => qr/--leg/, # a former option
  'tests/program/view_element.sh' => qr/--leg/,
  'CONTRIBUTING.md' => qr/^\|/,   # its table of words
  'tests/bench/yade_w1.py' => qr/\b(?:body|bodies)\b/, # names of YADE
);

sub spoken {    # names part by part, in lower case
  my $text = shift;
  $text =~ s/([a-z0-9])([A-Z])/$1 $2/g;
  $text =~ tr/_/ /;
  return lc $text;
}

my @files = grep { -f && !m{^tests/fuzz/corpus/|\.(png|h5|csv)$|^LICENSE$} } split /\n/,
  `git -c safe.directory='*' ls-files --cached --others --exclude-standard`;
die "words.pl: no files in $root\n" unless @files;

# One look at a line tells whether any word is in it.
sub any_of { my $all = join '|', map { $_->[0] } @_; return qr/\b(?:$all)\b/; }
my ($any_word, $any_word_of_code) = (any_of(@words), any_of(@words_of_code));

my $found = 0;
for my $file (@files) {
  open my $in, '<', $file or die "words.pl: $file: $!\n";
  my $is_code = $file =~ m{^(?:dem|coupling)/.*\.(?:cc|h)$};
  while (my $line = <$in>) {
    next if exists $allowed{$file} && $line =~ $allowed{$file};
    next if $line =~ /former_(?:name|section)\(/;    # refuses an old key
    (my $text = $line) =~ s/"(?:bodies|[a-z0-9]+_[a-z0-9_]*)//g;   # names on disk
    my $said_of_all = spoken($text);
    my @rules;
    push @rules, map { [$said_of_all, @$_] } @words if $said_of_all =~ $any_word;
    if ($is_code) {
      (my $code = $text) =~ s{//.*}{};
      $code =~ s/"(?:[^"\\]|\\.)*"//g;
      $code =~ s/#include.*//;
      my $said_of_code = spoken($code);
      push @rules, map { [$said_of_code, @$_] } @words_of_code if $said_of_code =~ $any_word_of_code;
    }
    for (@rules) {
      my ($said, $word, $use, $but) = @$_;
      $said =~ s/$but//g if $but;
      next unless $said =~ /\b($word)\b/;
      print "$file:$.: \"$1\": use \"$use\": $line";
      $found++;
    }
  }
}
print $found ? "words: $found found\n" : "words: none of those that are not used\n";
exit($found ? 1 : 0);
