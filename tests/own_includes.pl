#!/usr/bin/env perl
# Every source includes what it names, itself or by headers of the repository: the build would not notice, because
# it reads the headers of this list precompiled (precompile() of CMakeLists.txt).
#
# usage: own_includes.pl [ROOT]
use strict;
use warnings;
use File::Basename;
use File::Find;

my $root = shift // dirname(__FILE__) . "/..";
my %names = (    # header => what it declares
  'algorithm'  => 'std::(?:sort|stable_sort|clamp|any_of|all_of|none_of|find|find_if|max_element|min_element|minmax|copy|count|count_if|lower_bound|upper_bound|nth_element|fill|reverse|unique|is_sorted|min|max|swap_ranges|transform|rotate)\b',
  'array'      => 'std::array\b',
  'cmath'      => 'std::(?:sqrt|sin|cos|tan|pow|isfinite|isnan|isinf|hypot|log|log10|log2|log1p|exp|expm1|floor|ceil|lround|llround|round|nan|asin|acos|atan|atan2|cbrt|copysign|signbit|tgamma|lgamma|erf|erfc|fma)\b',
  'cstdint'    => 'std::u?int(?:8|16|32|64)_t\b',
  'filesystem' => 'std::filesystem\b',
  'fstream'    => 'std::(?:ifstream|ofstream|fstream)\b',
  'functional' => 'std::(?:function|reference_wrapper|hash|ref|cref)\b',
  'map'        => 'std::(?:map|multimap)\b',
  'memory'     => 'std::(?:unique_ptr|shared_ptr|make_unique|make_shared)\b',
  'numeric'    => 'std::(?:accumulate|iota|gcd|lcm|inner_product|partial_sum|reduce)\b',
  'sstream'    => 'std::(?:istringstream|ostringstream|stringstream)\b',
  'string'     => 'std::(?:string|to_string|stod|stoi|getline)\b(?!_view)',
  'vector'     => 'std::vector\b',
  'Eigen/Core' => 'Eigen::(?:Matrix|Vector|Array|Map|Ref)',
);
# Headers that stand for another.
my %gives = ('Eigen/Geometry' => 'Eigen/Core', 'Eigen/Dense' => 'Eigen/Core', 'Eigen/Eigenvalues' => 'Eigen/Core',
  'Eigen/Cholesky' => 'Eigen/Core', 'Eigen/LU' => 'Eigen/Core', 'Eigen/SVD' => 'Eigen/Core', 'Eigen/Sparse' => 'Eigen/Core');

{
  open my $file, '<', "$root/CMakeLists.txt" or die "CMakeLists.txt: $!\n";
  local $/;
  my ($precompiled) = <$file> =~ /^set\(pch_std ([^)]*)\)/m or die "CMakeLists.txt: no pch_std\n";
  for ($precompiled =~ /<([^>]*)>/g) {
    die "own_includes.pl does not know what <$_> declares, which is precompiled\n" unless $names{$_};
  }
}

my %text;
my %includes;    # of a file: its own, from <> and ""
for my $folder (qw(dem fem coupling apps tests)) {
  find({no_chdir => 1, wanted => sub {
    return unless /\.(?:h|cc)$/;
    open my $file, '<', $_ or die "$_: $!\n";
    local $/;
    my $source = <$file>;
    my $name = $_;
    $name =~ s{^\Q$root\E/}{};
    $includes{$name} = [$source =~ /^\s*#\s*include\s*[<"]([^>"]+)[>"]/mg];
    $source =~ s{R"([^(]*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|//[^\n]*|/\*.*?\*/}{}gs;
    $text{$name} = $source;
  }}, "$root/$folder");
}

my %reached;     # of a file: all headers, through those of the repository
sub headers_of {
  my ($file) = @_;
  return $reached{$file} if $reached{$file};
  my %all;
  $reached{$file} = \%all;
  for my $header (@{$includes{$file}}) {
    $all{$header} = 1;
    $all{$gives{$header}} = 1 if $gives{$header};
    my ($own) = grep { $includes{$_} } $header, dirname($file) . "/$header", "tests/$header";
    %all = (%all, %{headers_of($own)}) if defined $own;
  }
  return \%all;
}

my $wrong = 0;
for my $file (sort keys %text) {
  my $seen = headers_of($file);
  for my $header (sort keys %names) {
    next if $seen->{$header} || $text{$file} !~ /($names{$header})/;
    print "$file: names $1 without #include <$header>\n";
    ++$wrong;
  }
}
die "found no sources in $root\n" unless %text;
exit($wrong ? 1 : 0);
