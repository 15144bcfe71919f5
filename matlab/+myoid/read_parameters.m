function parameters = read_parameters(results)
  % READ_PARAMETERS  The identified parameters of a run.
  %   p = myoid.read_parameters('results')
  % results: the folder, or its parameters.csv. Returns the table of parameters.csv: a row for each muscle, parameter,
  % method and case, with estimate, ci_low, ci_high (95 %), verdict and reason. In Octave, which has no tables, a
  % struct with a field for each column: numbers as n x 1 (NaN where there is none), texts as cell arrays.
  file = results;
  if exist(results, 'dir')
    file = fullfile(results, 'parameters.csv');
  end
  rows = cells_of(fileread(file));
  parameters = struct();
  texts = {'muscle', 'parameter', 'unit', 'method', 'case', 'verdict', 'reason'};
  flags = {'at_bound', 'routes_disagree'};
  for r = 2:numel(rows)
    if numel(rows{r}) ~= numel(rows{1})
      error('myoid:badInput', '%s: row %d has %d cells, expected %d as in the header', file, r, numel(rows{r}), ...
            numel(rows{1}));
    end
  end
  for c = 1:numel(rows{1})
    name = rows{1}{c};
    column = cellfun(@(row) row{c}, rows(2:end), 'UniformOutput', false)';
    if any(strcmp(name, texts))
      parameters.(field_of(name)) = column;
    elseif any(strcmp(name, flags))
      parameters.(name) = strcmp(column, 'true');
    else
      numbers = str2double(column);
      wrong = find(isnan(numbers) & ~cellfun(@isempty, column) & ~strcmpi(column, 'nan'), 1);
      if ~isempty(wrong)
        error('myoid:badInput', '%s: row %d, column ''%s'': expected a number, found ''%s''', file, wrong + 1, name, ...
              column{wrong});
      end
      parameters.(name) = numbers;
    end
  end
  if ~exist('OCTAVE_VERSION', 'builtin')
    parameters = struct2table(parameters);
  end
end

function name = field_of(name)
  % `case` is a word of the language.
  if strcmp(name, 'case')
    name = 'fit_case';
  end
end

function rows = cells_of(text)
  % The cells of a table with commas; quotes as RFC 4180 has them. Goes from mark to mark, since names may be long.
  text = text(:)';
  marks = find(text == '"' | text == ',' | text == char(10) | text == char(13));
  rows = {};
  row = {};
  cell_text = '';
  quoted = false;
  from = 1;
  for k = marks
    c = text(k);
    if k < from || (quoted && c ~= '"')
      continue  % the second of two quotes; a mark inside quotes
    end
    cell_text = [cell_text, text(from:k - 1)]; %#ok<AGROW>
    from = k + 1;
    if quoted && k < numel(text) && text(k + 1) == '"'
      cell_text(end + 1) = '"'; %#ok<AGROW>
      from = k + 2;
    elseif c == '"'
      quoted = ~quoted;
    elseif c ~= char(13)
      row{end + 1} = cell_text; %#ok<AGROW>
      cell_text = '';
      if c == char(10)
        rows{end + 1} = row; %#ok<AGROW>
        row = {};
      end
    end
  end
  cell_text = [cell_text, text(from:end)];
  if ~isempty(row) || ~isempty(cell_text)
    row{end + 1} = cell_text;
    rows{end + 1} = row;
  end
end
